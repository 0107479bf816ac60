// study.csv is read as it was written, and torn rows are no runs.
#include "rollwave/study/study_record.h"

#include <gtest/gtest.h>

#include <random>

using namespace rollwave;

namespace {

std::vector<StudyRun> two_runs() {
  StudyRun solved;
  solved.scene = "thin, and fast";
  solved.settings = {{"Road", "Contact zone", "4.5, 5", ""}};
  solved.reference = "the semi-analytic solution";
  solved.figures = {{"force", 0.1}, {"energy", 1. / 3}, {"dofs", 1234}};
  StudyRun failed = solved;
  solved.remarks = "rough, \"or so\"";
  failed.failure = "no \"way\",\nat all";
  failed.figures = {{"dofs", 5}};
  return {solved, failed};
}

TEST(StudyCsv, IsReadAsItWasWritten) {
  const auto runs = two_runs();
  const auto read = read_study_csv(study_csv(runs));
  ASSERT_EQ(read.size(), 2u);
  for (unsigned int i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].reference, runs[i].reference);
    EXPECT_EQ(read[i].figures, runs[i].figures);
  }
  EXPECT_EQ(read[0].remarks, "rough, 'or so'");
  EXPECT_TRUE(read[1].remarks.empty());
  EXPECT_TRUE(read[0].failure.empty());
  EXPECT_EQ(read[1].failure, "no 'way', at all");
  EXPECT_TRUE(read_study_csv(study_csv({})).empty());
}

// A row that lacks fields is no run, nor is what follows it.
TEST(StudyCsv, MayLackAnything) {
  const std::string whole = study_csv(two_runs());
  const auto begin_of_row = whole.find('\n') + 1;
  std::string without_begin = whole;
  without_begin.erase(begin_of_row, whole.find("the semi") + 4 - begin_of_row);
  EXPECT_TRUE(read_study_csv(without_begin).empty());

  // Cut anywhere, it has whole rows with their figures or none.
  const std::vector<StudyRun> runs = read_study_csv(whole);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::vector<StudyRun> read = read_study_csv(whole.substr(0, size));
    ASSERT_EQ(read.size(), size < whole.find('\n', begin_of_row) + 1 ? 0u : 1u) << size;
    if (!read.empty()) {
      EXPECT_EQ(read[0].figures, runs[0].figures);
    }
  }

  std::minstd_rand random(1);
  for (unsigned int i = 0; i < 3000; ++i) {
    std::string torn = whole;
    torn.erase(random() % whole.size(), 1 + random() % 200);
    EXPECT_NO_THROW(read_study_csv(torn));
  }
}

} // namespace
