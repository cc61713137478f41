// Programmer mistakes: fail with the expression and its operands (failure.h). Faults of the outside world
// (files, devices, shaders) are Result<T> instead, see result.h.
#pragma once

#include <sstream>
#include <string>

namespace ag {

[[noreturn]] void checkFailed(const char* file, int line, const char* expression, const std::string& detail);

namespace detail {
template <class A, class B>
std::string operands(const A& a, const B& b) {
    std::ostringstream out;
    out << a << " against " << b;
    return out.str();
}
}  // namespace detail
}  // namespace ag

#define AG_CHECK(condition)                                                      \
    do {                                                                         \
        if (!(condition)) ::ag::checkFailed(__FILE__, __LINE__, #condition, {}); \
    } while (false)

#define AG_CHECK_MSG(condition, message)                                              \
    do {                                                                              \
        if (!(condition)) ::ag::checkFailed(__FILE__, __LINE__, #condition, message); \
    } while (false)

#define AG_CHECK_OP(a, op, b)                                              \
    do {                                                                   \
        const auto& agCheckA = (a);                                        \
        const auto& agCheckB = (b);                                        \
        if (!(agCheckA op agCheckB))                                       \
            ::ag::checkFailed(__FILE__, __LINE__, #a " " #op " " #b,       \
                              ::ag::detail::operands(agCheckA, agCheckB)); \
    } while (false)

#define AG_CHECK_EQ(a, b) AG_CHECK_OP(a, ==, b)
#define AG_CHECK_LT(a, b) AG_CHECK_OP(a, <, b)
#define AG_CHECK_LE(a, b) AG_CHECK_OP(a, <=, b)
