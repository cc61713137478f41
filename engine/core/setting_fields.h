// The fields of a settings struct, listed once in it: registration, hash and the promise that none is
// forgotten follow from the list.
//
//   struct RsmSettings {
//       uint32_t resolution = 0;
//
//       static constexpr auto fields() {
//           return std::tuple{SettingField{"resolution", &RsmSettings::resolution, 0, 1024, "texels", "side
//           of an RSM"}};
//       }
//   };
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "engine/core/hash.h"
#include "engine/core/settings.h"

namespace ag {

template <class S, class T>
struct SettingField {
    const char* name;
    T S::*member;
    double min = 0, max = 0;  // of numbers
    const char* unit = "";
    const char* help = "";
    const char* choices = "";  // of enumerations: "point|disk", by value from 0
    bool listed = true;

    constexpr SettingField unlisted() const {  // nothing for users to set
        SettingField f = *this;
        f.listed = false;
        return f;
    }
};
template <class S, class T, class... Rest>
SettingField(const char*, T S::*, Rest...) -> SettingField<S, T>;

namespace detail {

struct AnyField {
    template <class T>
    constexpr operator T() const;
};
// How many members an aggregate has: the most that it can be made from.
template <class S, class... Given>
constexpr size_t memberCount() {
    if constexpr (requires { S{Given{}..., AnyField{}}; })
        return memberCount<S, Given..., AnyField>();
    else
        return sizeof...(Given);
}

template <class S, class Visit>
void forFields(Visit&& visit) {
    static_assert(std::tuple_size_v<decltype(S::fields())> == memberCount<S>(),
                  "a member of the struct is not in its list of fields");
    std::apply([&](const auto&... field) { (visit(field), ...); }, S::fields());
}

std::vector<std::string> split(std::string_view choices);

}  // namespace detail

template <class S>
void registerFields(Settings& settings, const char* group, S& values) {
    detail::forFields<S>([&](const auto& f) {
        if (f.listed)
            settings.add({group, f.name, f.min, f.max, f.unit, f.help, detail::split(f.choices)},
                         &(values.*f.member));
    });
}

// Of all its values.
template <class S>
uint64_t hashFields(const S& values, uint64_t seed = 0) {
    detail::forFields<S>([&](const auto& f) { seed = hashValue(values.*f.member, seed); });
    return seed;
}

}  // namespace ag
