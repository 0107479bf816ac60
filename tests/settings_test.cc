// The reader of parameter files keeps the place of every entry and refuses what it cannot read.
#include "own_path.h"
#include "rollwave/base/errors.h"
#include "rollwave/parameters/prm_reader.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace rollwave;

namespace {

std::vector<Setting> read_text(const std::string& text) {
  const std::filesystem::path file = own_path();
  std::ofstream(file) << text;
  return read_settings(file);
}

std::string refusal_of_text(const std::string& text) {
  try {
    read_text(text);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Settings, KeepSectionKeyValueAndLine) {
  const auto settings = read_text("# a scene\n\nsubsection Mesh\n  set Degree = 2 # Q2\nend\r\n"
                                  "subsection Study\n set Vary = A/B = 1 | \\\n   2\nend\n");
  ASSERT_EQ(settings.size(), 2u);
  EXPECT_EQ(settings[0].path(), "Mesh/Degree");
  EXPECT_EQ(settings[0].value, "2");
  EXPECT_NE(settings[0].origin.find("line 4"), std::string::npos);
  EXPECT_EQ(settings[1].path(), "Study/Vary");
  EXPECT_EQ(settings[1].value, "A/B = 1 | 2");
}

TEST(Settings, MayBeginWithAByteOrderMark) {
  const auto settings = read_text("\xEF\xBB\xBFsubsection Mesh\n set Degree = 2\nend\n");
  ASSERT_EQ(settings.size(), 1u);
  EXPECT_EQ(settings[0].path(), "Mesh/Degree");
}

TEST(Settings, RefuseWhatIsNotOfTheGrammar) {
  EXPECT_NE(refusal_of_text("subsection Mesh\nDegree = 2\nend\n").find("line 2"),
            std::string::npos);
  EXPECT_NE(refusal_of_text("subsection Mesh\nset Degree 2\nend\n").find("line 2"),
            std::string::npos);
  EXPECT_NE(refusal_of_text("end\n").find("without a subsection"), std::string::npos);
  EXPECT_NE(refusal_of_text("subsection Mesh\n").find("not closed"), std::string::npos);
  EXPECT_NE(refusal_of_text("subsection A\nsubsection B\nend\nend\n").find("inside"),
            std::string::npos);
  EXPECT_NE(refusal_of_text("subsection\nend\n").find("name"), std::string::npos);
  EXPECT_NE(refusal_of_text("subsection A\nset B = 1\nset B = 2\nend\n").find("second time"),
            std::string::npos);
}

TEST(Settings, SayWhyAFileCannotBeRead) {
  for (const auto& [file, reason] :
       {std::pair<std::string, std::string>{"/no/such/file.prm", "No such file"},
        {testing::TempDir(), "Is a directory"}})
    try {
      read_settings(file);
      ADD_FAILURE() << file;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  EXPECT_NE(refusal_of_text("\xFF\xFEs\0u\0").find("UTF-16"), std::string::npos);
  EXPECT_NE(refusal_of_text("subsection Mesh\rend\r").find("byte 0D"), std::string::npos);
  EXPECT_NE(refusal_of_text("subsection Mesh\n set\xC2\xA0"
                            "Degree = 2\nend\n")
                .find("\\xC2\\xA0"),
            std::string::npos);
}

TEST(Settings, TakeAValueInQuotesAsItIs) {
  const auto settings =
      read_text("subsection Output\n set Directory = \" a # b\\\" # \"c\"\nend\n");
  ASSERT_EQ(settings.size(), 1u);
  EXPECT_EQ(settings[0].value, " a # b\\");
}

TEST(Settings, RefuseWhatIsNoTextOrHasNoEnd) {
  EXPECT_NE(refusal_of_text(std::string(1 << 20, '\n') + "end\n").find("1 MiB"), std::string::npos);
  EXPECT_THROW(read_settings("/dev/zero"), BadInput);
  const std::string binary = refusal_of_text(std::string("\x7f"
                                                         "ELF\0\x1b[2J",
                                                         9) +
                                             std::string(10000, '\x01'));
  EXPECT_LT(binary.size(), 1000u);
  EXPECT_EQ(binary.find_first_of(std::string("\x7f\0\x1b\x01", 4)), std::string::npos) << binary;
}

TEST(Settings, ReadAssignments) {
  const Setting setting = parse_setting("Contact/Most steps = 7", "--set");
  EXPECT_EQ(setting.section, "Contact");
  EXPECT_EQ(setting.key, "Most steps");
  EXPECT_EQ(setting.value, "7");
  EXPECT_THROW(parse_setting("Contact", "--set"), BadInput);
  EXPECT_EQ(parse_setting("a=b/c", "--set").section, ""); // which is refused as a key is
}

} // namespace
