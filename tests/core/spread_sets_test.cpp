#include "engine/core/spread_sets.h"

#include <gtest/gtest.h>

namespace ag {
namespace {

std::vector<std::string> spread(std::vector<std::string> words) {
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    std::vector<std::string> out = reversedArguments(argv);
    std::reverse(out.begin(), out.end());
    return out;
}

using Words = std::vector<std::string>;

TEST(SpreadSets, EveryAssignmentIsOne) {
    EXPECT_EQ(spread({"afterglow", "render", "--set", "a.b=1", "c_2.d=off", "cornell"}),
              (Words{"render", "--set", "a.b=1", "--set", "c_2.d=off", "cornell"}));
    EXPECT_EQ(spread({"afterglow", "--set", "a.b=1", "--set", "c.d=2"}),
              (Words{"--set", "a.b=1", "--set", "c.d=2"}));
    EXPECT_EQ(spread({"afterglow", "--set=a.b=1", "c.d=2"}), (Words{"--set=a.b=1", "--set", "c.d=2"}));
}

TEST(SpreadSets, NothingElseIsTouched) {
    for (const Words& words :
         {Words{"--set", "nonsense", "a.b=1"}, Words{"cornell", "a.b=1"}, Words{"--set"}, Words{},
          Words{"--set", "a.b=1", "scene.glb", "c.d=1"}, Words{"--set", "a.b=1", "../odd.file=1.glb"}}) {
        Words with = {"afterglow"};
        with.insert(with.end(), words.begin(), words.end());
        EXPECT_EQ(spread(with), words);
    }
    EXPECT_EQ(spread({}), Words{});
}

}  // namespace
}  // namespace ag
