#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace ag {
namespace {

std::string textOf(const std::string& path) {
    std::ifstream file(std::string(AFTERGLOW_SOURCE_DIR "/") + path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST(EcsDocs, TheExampleIsTheOneThatCompiles) {
    const std::string docs = textOf("docs/ecs.md"), example = textOf("tests/ecs/example/fireflies.cpp");
    ASSERT_GT(example.size(), 1000u);
    const std::string fence = "```cpp\n";
    const size_t begin = docs.find(fence);
    ASSERT_NE(begin, std::string::npos);
    const size_t end = docs.find("```\n", begin + fence.size());
    EXPECT_EQ(docs.substr(begin + fence.size(), end - begin - fence.size()), example);
}

}  // namespace
}  // namespace ag
