#include "rollwave/study/run_record.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/version.h"
#include "rollwave/run/quantities.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <system_error>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

fs::path path_of_record(const fs::path& directory, const std::string& digest) {
  return directory / "runs" / (digest + ".json");
}

Json files_json(const RunRecord& record) {
  const UnitNames& names = record.files.unit_names;
  return {{"kinds", text_of(record.files.kinds)},
          {"linear_cells", record.files.cells == CellKind::linear},
          {"picture_format", static_cast<int>(record.files.picture_format)},
          {"unit_names", {names.length, names.time, names.force}},
          {"bytes", record.sizes}};
}

/// @throws Json::exception, std::invalid_argument for another text
void read_files(const Json& json, RunRecord& record) {
  record.files.kinds = parse_files(json.at("kinds").get<std::string>());
  record.files.cells =
      json.at("linear_cells").get<bool>() ? CellKind::linear : CellKind::high_order;
  record.files.picture_format = static_cast<PictureFormat>(json.at("picture_format").get<int>());
  const Json& names = json.at("unit_names");
  record.files.unit_names = {names.at(0), names.at(1), names.at(2)};
  json.at("bytes").get_to(record.sizes);
}

/// True if all files of a record are in its directory, with their sizes.
bool has_files(const RunRecord& record, const fs::path& own_directory) {
  return std::all_of(record.sizes.begin(), record.sizes.end(), [&](const auto& file) {
    std::error_code error;
    return fs::file_size(own_directory / file.first, error) == file.second && !error;
  });
}

} // namespace

bool OwnFiles::include(const OwnFiles& wanted) const {
  return wanted.kinds.empty() ||
         (form() == wanted.form() &&
          std::includes(kinds.begin(), kinds.end(), wanted.kinds.begin(), wanted.kinds.end()));
}

OwnFiles wanted_files(const Parameters& study) {
  return {study.study.files_of_each_run, study.output.cells, study.output.picture_format,
          study.material.unit_names};
}

std::string to_json(const RunRecord& record, const std::string& digest) {
  std::vector<double> angles, road_lengths, pressures;
  for (const ProfilePoint& point : record.profile) {
    angles.push_back(point.angle);
    road_lengths.push_back(point.road_length);
    pressures.push_back(point.pressure);
  }
  Json json = {{"program", version_text()},
               {"run", digest},
               {"values", record.values},
               {"reference", record.reference},
               {"shortfalls", texts_of(record.notes, Note::Kind::shortfall)},
               {"remarks", texts_of(record.notes, Note::Kind::remark)},
               {"shared", record.shared},
               {"profile_angles", angles},
               {"profile_road_lengths", road_lengths},
               {"profile_pressures", pressures}};
  if (!record.files.kinds.empty())
    json["files"] = files_json(record);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::optional<RunRecord> from_json(const std::string& text, const std::string& digest) {
  try {
    const Json all = Json::parse(text);
    RunRecord record;
    all.at("values").get_to(record.values);
    all.at("reference").get_to(record.reference);
    for (const Json& text : all.at("shortfalls"))
      record.notes.push_back({Note::Kind::shortfall, text});
    for (const Json& text : all.at("remarks"))
      record.notes.push_back({Note::Kind::remark, text});
    all.at("shared").get_to(record.shared);
    const Json &angles = all.at("profile_angles"), &road_lengths = all.at("profile_road_lengths"),
               &pressures = all.at("profile_pressures");
    for (std::size_t i = 0; i < angles.size(); ++i)
      record.profile.push_back({angles.at(i), road_lengths.at(i), pressures.at(i)});
    if (all.contains("files"))
      read_files(all["files"], record);
    const bool is_of_run = all.at("run") == digest && record.is_solved();
    return is_of_run ? std::optional(record) : std::nullopt;
  } catch (const Json::exception&) {
  } catch (const std::invalid_argument&) {
  }
  return {};
}

fs::path directory_of_run(const std::string& digest) {
  return fs::path("runs") / digest;
}

std::optional<RunRecord> known_run(const fs::path& directory, const std::string& digest,
                                   const OwnFiles& wanted) {
  const std::string text = read_file(path_of_record(directory, digest));
  const auto record = text.empty() ? std::nullopt : from_json(text, digest);
  const bool is_known =
      record && record->files.include(wanted) &&
      (wanted.kinds.empty() || has_files(*record, directory / directory_of_run(digest)));
  return is_known ? record : std::nullopt;
}

void write_record(const fs::path& directory, const std::string& digest, const RunRecord& record) {
  write_file(path_of_record(directory, digest), to_json(record, digest));
}

std::map<std::string, double> values_of(const Result& result, const Units& units) {
  std::map<std::string, double> values;
  for (const ResultQuantity& quantity : result_quantities())
    if (const auto value = quantity.in_users_units(result, units))
      values[quantity.name] = *value;
  return values;
}

std::vector<ProfilePoint> profile_of(const Result& result, const Units& units) {
  const auto& rows = result.contact_rows;
  const auto presses = [](const ContactRow& row) { return row.pressure > 0; };
  const auto first = std::find_if(rows.begin(), rows.end(), presses);
  const auto last = std::find_if(rows.rbegin(), rows.rend(), presses).base();
  std::vector<ProfilePoint> profile;
  if (first == rows.end())
    return profile;
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, first - rows.begin() - 1),
                       end = std::min<std::ptrdiff_t>(rows.size(), last - rows.begin() + 1),
                       step = 1 + (end - begin) / 100;
  for (std::ptrdiff_t i = begin; i < end; ++i)
    if ((i - begin) % step == 0 || i + 1 == end)
      profile.push_back({rows[i].angle, rows[i].road_length * units.of(Quantity::length),
                         rows[i].pressure * units.of(Quantity::pressure)});
  return profile;
}

} // namespace rollwave
