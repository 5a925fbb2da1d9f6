#include "cli/base/style.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <random>
#include <sstream>

namespace contact::cli {
namespace {

TEST(Style, LinesAreBrokenBetweenWordsWhateverTheirColour) {
  const Style narrow{.width = 7};
  EXPECT_EQ(Wrap("one two three\n\nδδδ \x1b[1mδδδ\x1b[0m δδδδδδδδ\n", narrow),
            "one two\nthree\n\nδδδ \x1b[1mδδδ\x1b[0m\nδδδδδδδδ\n");
  EXPECT_EQ(Wrap("one two three\n", {}), "one two three\n");
}

TEST(Style, TextIsCutAndPaddedByCharacters) {
  EXPECT_EQ(Cut("δδδ", 2), "δδ");
  EXPECT_EQ(Cut("ab", 5), "ab");
  EXPECT_EQ(Pad("δ", 3), "δ  ");
  EXPECT_EQ(Pad("δ", -3), "  δ");
  EXPECT_EQ(Pad("abc", 2), "abc");
}

TEST(Style, TextOfAUserBecomesOneLineOfItsFirstCharacters) {
  EXPECT_EQ(OneLine("a\nb\x1b[31mc"), "a b [31mc");
  EXPECT_EQ(OneLine("μδε", 3), "μδε");
  EXPECT_EQ(OneLine("μδεα", 3), "μδ…");
}

TEST(Style, NoWrappedLineIsWiderThanTheTerminalUnlessAWordIs) {
  std::mt19937 random(1);
  for (int width = 10; width <= 100; ++width) {
    std::string text;
    for (int i = 0; i < 60; ++i) {
      text += std::string(1 + random() % 10, 'a') + (random() % 8 == 0 ? "\n" : " ");
    }
    std::istringstream lines(Wrap(text, {.width = width}));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(Width(line), width) << line;
  }
}

TEST(Style, WrappingKeepsTheWordsAndTheirOrder) {
  const auto words = [](const std::string& text) {
    std::istringstream stream(text);
    return std::vector<std::string>(std::istream_iterator<std::string>(stream), {});
  };
  const std::string text = "one two  three\nfour\n\nfive sixteen-letters-or-more six\n";
  for (int width = 1; width <= 40; ++width) {
    EXPECT_EQ(words(Wrap(text, {.width = width})), words(text)) << width;
  }
}

TEST(Style, ColourHasNoWidth) {
  const Style color{.color = true};
  for (const Tone tone :
       {Tone::kPlain, Tone::kStrong, Tone::kGood, Tone::kWarning, Tone::kBad, Tone::kFaint}) {
    EXPECT_EQ(Width(Paint("\u03b4 = 1", tone, color)), 5);
    EXPECT_EQ(Paint("\u03b4 = 1", tone, Style{}), "\u03b4 = 1");
  }
  EXPECT_EQ(Paint("x", Tone::kBad, color), "\x1b[31mx\x1b[0m");
}

TEST(Style, PartsShareALineWhereTheyFit) {
  EXPECT_THAT(Fold({"ab ", "cd ", "ef"}, 5), testing::ElementsAre("ab cd", "ef"));
  EXPECT_THAT(Fold({"abcdefgh", "i"}, 5), testing::ElementsAre("abcdefgh", "i"));
  EXPECT_THAT(Fold({"ab ", "cd"}, 0), testing::ElementsAre("ab cd"));
}

// Sets a variable of the environment for a scope.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    const char* before = std::getenv(name);
    if (before != nullptr) before_ = before;
    was_set_ = before != nullptr;
    value == nullptr ? unsetenv(name) : setenv(name, value, 1);
  }
  ~Variable() { was_set_ ? setenv(name_, before_.c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::string before_;
  bool was_set_ = false;
};

TEST(Style, FirstVariableOfTheLocaleThatIsSetDecidesOnUtf8) {
  const Variable language("LANG", "C.UTF-8");
  const Variable type("LC_CTYPE", nullptr);
  {
    const Variable all("LC_ALL", "");
    EXPECT_TRUE(TerminalHasUtf8());
    const Variable other("LC_CTYPE", "C");
    EXPECT_FALSE(TerminalHasUtf8());
  }
  const Variable all("LC_ALL", "de_DE.utf8");
  EXPECT_TRUE(TerminalHasUtf8());
}

TEST(Style, OnlyAlwaysColoursWhatIsNoTerminal) {
  const std::FILE* file = std::tmpfile();
  const int descriptor = fileno(const_cast<std::FILE*>(file));
  EXPECT_TRUE(StyleOf(descriptor, "always").color);
  for (const char* color : {"auto", "never"}) EXPECT_FALSE(StyleOf(descriptor, color).color);
  EXPECT_FALSE(StyleOf(descriptor, "auto").terminal);
  EXPECT_EQ(StyleOf(descriptor, "auto").width, 0);
  std::fclose(const_cast<std::FILE*>(file));
}

}  // namespace
}  // namespace contact::cli
