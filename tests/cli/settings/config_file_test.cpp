#include <gmock/gmock.h>

#include <algorithm>

#include "cli/base/failure.h"
#include "cli/settings/config.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;

const std::vector<std::string_view> kKeys = {"server", "output", "timeout", "profile"};

ConfigFile Read(const std::string& text) { return ReadConfig("my.toml", text, kKeys); }

TEST(ConfigFileTest, ValuesKnowTheirLine) {
  const ConfigFile file = Read("# mine\nserver = \"lab:1\"\n\n[profile.lab]\ntimeout = '3s'\n");
  EXPECT_EQ(file.mistake, "");
  EXPECT_EQ(file.values.at("server").text, "lab:1");
  EXPECT_EQ(file.values.at("server").origin, "my.toml:2");
  EXPECT_EQ(file.profiles.at("lab").at("timeout").origin, "my.toml:5");
}

TEST(ConfigFileTest, UseProfileChoosesTheProfile) {
  EXPECT_EQ(Read("use_profile = 'lab'\n").values.at("profile").text, "lab");
}

TEST(ConfigFileTest, WholeNumbersAreTexts) {
  EXPECT_EQ(Read("timeout = 10\n").values.at("timeout").text, "10");
}

TEST(ConfigFileTest, MistakeIsToldAtItsPlace) {
  EXPECT_THAT(Read("server = 'x:1'\nsevrer = 'y:1'\n").mistake,
              "my.toml:2:10: unknown key 'sevrer' — did you mean 'server'?");
  EXPECT_THAT(Read("server = [1]\n").mistake, HasSubstr("server must be a text"));
  EXPECT_THAT(Read("server = true\n").mistake, HasSubstr("server must be a text"));
  EXPECT_THAT(Read("profile = 'lab'\n").mistake, HasSubstr("use_profile chooses one"));
  EXPECT_THAT(Read("[profile]\nlab = 1\n").mistake, HasSubstr("a profile is a section"));
  EXPECT_THAT(Read("server =\n").mistake, testing::StartsWith("my.toml:1:"));
}

TEST(ConfigFileTest, UnknownKeyWithoutNeighbourHasNoHint) {
  EXPECT_THAT(Read("colour_of_the_sky = 'blue'\n").mistake,
              testing::Not(HasSubstr("did you mean")));
}

TEST(FindValueTest, ProfileOfAnyFileWinsOverWhatStandsOutside) {
  const std::vector<ConfigFile> files = {
      Read("server = 'first:1'\n"), Read("server = 'last:1'\n[profile.lab]\nserver='lab:1'\n")};
  EXPECT_EQ(FindValue(files, "server", "lab")->text, "lab:1");
  EXPECT_EQ(FindValue(files, "server", "")->text, "first:1");
  EXPECT_EQ(FindValue(files, "server", "home")->text, "first:1");
  EXPECT_EQ(FindValue(files, "timeout", "lab"), std::nullopt);
}

// Reading what was written gives the value; every other line is as it was.
void ExpectChange(const std::string& before, const std::string& profile, const std::string& key,
                  const std::string& value, const std::string& after) {
  const std::string changed = WithValue(before, profile, key, value);
  EXPECT_EQ(changed, after);
  EXPECT_EQ(FindValue({Read(changed)}, key, profile)->text, value);
}

TEST(WithValueTest, NewValueStandsAfterTheOthersOfItsSection) {
  ExpectChange("", "", "server", "a:1", "server = 'a:1'\n");
  ExpectChange("# mine\noutput = 'json'\n\n[profile.lab]\n# theirs\n", "", "server", "a:1",
               "# mine\noutput = 'json'\nserver = 'a:1'\n\n[profile.lab]\n# theirs\n");
}

TEST(WithValueTest, OldValueIsReplacedInItsSectionOnly) {
  ExpectChange("server = 'a:1'\n[profile.lab]\nserver = 'b:1'\n", "lab", "server", "c:1",
               "server = 'a:1'\n[profile.lab]\nserver = 'c:1'\n");
}

TEST(WithValueTest, NewProfileBecomesASectionAtTheEnd) {
  ExpectChange("server = 'a:1'\n", "lab", "timeout", "3s",
               "server = 'a:1'\n\n[profile.lab]\ntimeout = '3s'\n");
}

TEST(WithValueTest, ProfileInUseIsWrittenAsUseProfile) {
  EXPECT_EQ(WithValue("", "", "profile", "lab"), "use_profile = 'lab'\n");
}

TEST(WithValueTest, ApostropheIsKept) {
  ExpectChange("", "", "server", "it's:1", "server = \"it's:1\"\n");
}

TEST(WithValueTest, TextThatOneLineCannotChangeIsRefused) {
  EXPECT_THROW(WithValue("server = '''\na:1'''\n", "", "server", "b:1"), Failure);
  EXPECT_THROW(WithValue("", "", "server", "'\"both"), Failure);
}

}  // namespace
}  // namespace contact::cli
