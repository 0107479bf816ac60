#include "rollwave/study/run_record.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/version.h"
#include "rollwave/parameters/key.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <system_error>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

fs::path path_of_record(const fs::path& directory, const std::string& digest) {
  return directory / "runs" / (digest + ".json");
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
  return std::includes(kinds.begin(), kinds.end(), wanted.kinds.begin(), wanted.kinds.end()) &&
         std::includes(form.begin(), form.end(), wanted.form.begin(), wanted.form.end());
}

OwnFiles own_files(const Parameters& study, const std::set<OutputFile>& kinds) {
  OwnFiles files = {kinds, {}};
  const auto depend_on = [&](const std::string& name) {
    files.form[name] = value_of(key_of({"Output", name, "", ""}), study.settings);
  };
  if (!kinds.empty())
    depend_on("Unit names");
  if (kinds.count(OutputFile::solution) > 0)
    depend_on("Cells");
  if (kinds.count(OutputFile::plot) > 0)
    depend_on("Picture format");
  return files;
}

std::string to_json(const RunRecord& record, const std::string& digest) {
  std::vector<std::array<double, 3>> profile;
  for (const auto& [angle, road_length, pressure] : record.profile)
    profile.push_back({{angle, road_length, pressure}});
  Json json = {{"program", version_text()},
               {"run", digest},
               {"values", record.values},
               {"reference", record.reference},
               {"shortfalls", texts_of(record.notes, Note::Kind::shortfall)},
               {"remarks", texts_of(record.notes, Note::Kind::remark)},
               {"shared", record.shared},
               {"profile", profile}};
  if (!record.files.kinds.empty())
    json["files"] = {{"kinds", text_of(record.files.kinds)},
                     {"form", record.files.form},
                     {"bytes", record.sizes}};
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
    for (const Json& point : all.at("profile"))
      record.profile.push_back({point.at(0), point.at(1), point.at(2)});
    if (all.contains("files")) {
      const Json& files = all["files"];
      record.files.kinds = parse_files(files.at("kinds").get<std::string>());
      files.at("form").get_to(record.files.form);
      files.at("bytes").get_to(record.sizes);
    }
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
