#include "rollwave/study/run_digest.h"

#include "rollwave/base/text.h"
#include "rollwave/base/version.h"

#include <boost/algorithm/string/erase.hpp>

#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

namespace rollwave {

namespace {

/// Values one after another, such that two lists of values have the same text only if they agree.
struct TextOfValues {
  std::string text;

  void add(double value) { text += shortest_text(value) + ' '; }
  void add(const std::string& value) { text += std::to_string(value.size()) + ':' + value; }

  template <typename Choice>
  std::enable_if_t<std::is_enum_v<Choice>> add(Choice value) {
    add(static_cast<double>(value));
  }

  template <typename T>
  void add(const std::optional<T>& value) {
    text += value ? "+" : "-";
    if (value)
      add(*value);
  }

  template <typename First, typename Second>
  void add(const std::pair<First, Second>& values) {
    add(values.first);
    add(values.second);
  }

  template <typename Options>
  auto add(const Options& options) -> decltype(options.members(), void()) {
    std::apply([this](const auto&... members) { (add(members), ...); }, options.members());
  }
};

} // namespace

std::string digest_of_run(const RunOptions& options, bool has_true_errors) {
  CylinderOptions cylinder = options.cylinder;
  boost::algorithm::erase_all(cylinder.radial_force, " ");
  RoadOptions road = options.road;
  if (road.load)
    road.distance = RoadOptions().distance; // which is not used
  MaterialOptions material = options.material;
  material.unit_names = {};
  TextOfValues values;
  values.add(cylinder);
  values.add(road);
  values.add(material);
  values.add(static_cast<const MeshOptions&>(options.mesh));
  values.add(static_cast<const RefinementOptions&>(options.mesh));
  values.add(options.certificate);
  values.add(options.contact);
  values.add(has_true_errors);
  return digest_with_build(values.text);
}

std::string digest_of_files(const std::string& digest_of_run, const Parameters& study) {
  TextOfValues values{digest_of_run};
  values.add(study.output.cells);
  values.add(study.material.unit_names);
  for (const OutputFile kind : study.study.files_of_each_run)
    values.add(kind);
  return digest_with_build(values.text);
}

} // namespace rollwave
