#pragma once

#include "rollwave/parameters/output_options.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/run/result.h"
#include "rollwave/scene/units.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace rollwave {

/// The files that a run of a study has of its own, and what they depend on besides the run.
struct OwnFiles {
  std::set<OutputFile> kinds;              ///< none: no files
  std::map<std::string, std::string> form; ///< the values of the keys that change their content

  /// True if @p wanted are among these.
  bool include(const OwnFiles& wanted) const;
};

/// Files of these kinds with the parameters of a study.
OwnFiles own_files(const Parameters& study, const std::set<OutputFile>& kinds);

/// A point of the contact, in the user's units.
struct ProfilePoint {
  double angle;
  double road_length; ///< see ContactRow
  double pressure;

  auto members() const { return std::tie(angle, road_length, pressure); }
  bool operator==(const ProfilePoint& other) const { return members() == other.members(); }
};

/// The outcome of one run of a study.
struct RunRecord {
  /// The known result_quantities() by their names, in the user's units; none where it was not
  /// solved.
  std::map<std::string, double> values;
  std::string reference;   ///< what its errors are measured against; empty if there are none
  std::vector<Note> notes; ///< a shortfall says why it was not solved
  std::string shared;      ///< what it reuses from the run before; its seconds leave that out
  std::vector<ProfilePoint> profile; ///< the pressure along the contact
  OwnFiles files;
  std::map<std::string, std::uintmax_t> sizes; ///< of the files in bytes, by their names

  bool is_solved() const { return !values.empty(); }
};

/// The record of the run with a digest as text, numbers in the shortest form that is read back as
/// they are.
std::string to_json(const RunRecord& record, const std::string& digest);

/// nullopt for a text that is not a whole record of a solved run with this digest.
std::optional<RunRecord> from_json(const std::string& text, const std::string& digest);

/// The directory of a run's own files in that of the study.
std::filesystem::path directory_of_run(const std::string& digest);

/// The record of the run with a digest in the directory of a study: nullopt if it cannot be read,
/// or if it does not have the wanted files, with the sizes that it says.
std::optional<RunRecord> known_run(const std::filesystem::path& directory,
                                   const std::string& digest, const OwnFiles& wanted);

/// Writes the record of a solved run, whose files are there. @throws NotWritten
void write_record(const std::filesystem::path& directory, const std::string& digest,
                  const RunRecord& record);

/// The pressure from the node before contact to that after it, at about a hundred nodes at most,
/// in the user's units.
std::vector<ProfilePoint> profile_of(const Result& result, const Units& units);

} // namespace rollwave
