#ifndef ROLLWAVE_STUDY_STUDY_TABLE_H
#define ROLLWAVE_STUDY_STUDY_TABLE_H

#include "rollwave/study/convergence.h"
#include "rollwave/study/study_record.h"

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

/// A study as a table of at most a hundred letters in width, row by row while it goes on.
class StudyTable {
public:
  explicit StudyTable(const Study& study);

  std::string header() const;

  /// The row of a run that has been made. @p outcome stands at its end where it is solved.
  std::string row(unsigned int run, const std::string& outcome = "") const;

  /// All rows as a LaTeX document.
  std::string tex() const;

private:
  struct Column {
    std::string title; ///< its words stand one below the other
    unsigned int width;
    std::function<std::string(unsigned int run)> cell;
  };

  void add_settings();
  void make_narrower();
  void add_figure(const std::string& title, unsigned int width, const std::string& figure,
                  int digits);

  const Study& study;
  const std::vector<Family> families;
  std::vector<Column> columns;
};

/// What is to be said to the table: failures and remarks once for all runs that have them, and the
/// orders of errors.
void print_study_notes(std::ostream& out, const Study& study);

} // namespace rollwave

#endif
