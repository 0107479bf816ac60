#include "rollwave/output/summary_json.h"

#include "rollwave/base/version.h"
#include "rollwave/run/quantities.h"
#include "rollwave/scene/units.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace rollwave {

namespace {

using Json = nlohmann::ordered_json;

Json scene_json(const Scene& scene, const RunOptions& options) {
  Json json = {{"inner_radius", options.cylinder.inner_radius},
               {"outer_radius", options.cylinder.outer_radius},
               {"angular_velocity", options.cylinder.angular_velocity},
               {"road_curvature", options.road.curvature},
               {"radial_force", options.cylinder.radial_force},
               {"zone_begin", scene.zone_begin},
               {"zone_end", scene.zone_end}};
  const MaterialOptions& material =
      scene.units.material; // calibrated, where load and nip are given
  const auto& names = material.unit_names;
  if (material.is_given())
    json["material"] = {{"shear_modulus", material.shear_modulus},
                        {"density", material.density},
                        {"width", material.width}};
  if (!names.length.empty())
    json["unit_names"] = {{"length", names.length}, {"time", names.time}, {"force", names.force}};
  return json;
}

/// null for a number that is not known.
Json json_of(std::optional<double> number, double unit = 1) {
  return number ? Json(*number * unit) : Json();
}

void add_quantities(const Result& result, const Units& units, Json& json) {
  for (const ResultQuantity& quantity : result_quantities()) {
    const auto value = quantity.in_users_units(result, units);
    std::string path = '/' + quantity.name;
    std::replace(path.begin(), path.end(), '.', '/');
    json[Json::json_pointer(path)] = value && quantity.quantity == Quantity::count
                                         ? Json(static_cast<long>(*value))
                                         : json_of(value);
  }
}

Json patches_json(const Result& result, const Units& units) {
  Json json = Json::array();
  for (const ContactPatch& patch : result.contact.patches)
    json.push_back({{"left_end", patch.begin},
                    {"left_end_uncertainty", patch.begin_uncertainty},
                    {"right_end", patch.end},
                    {"right_end_uncertainty", patch.end_uncertainty},
                    {"length", patch.length * units.of(Quantity::length)},
                    {"length_uncertainty", patch.length_uncertainty * units.of(Quantity::length)},
                    {"force", patch.force * units.of(Quantity::force)},
                    {"centroid", patch.centroid},
                    {"peak_pressure", patch.peak_pressure * units.of(Quantity::pressure)}});
  return json;
}

Json cycles_json(const Result& result, const Units& units) {
  Json json = Json::array();
  for (const CycleFigures& cycle : result.cycles)
    json.push_back({{"cells", cycle.n_cells},
                    {"dofs", cycle.n_unknowns},
                    {"contact_steps", cycle.contact_steps},
                    {"road_distance", cycle.road_distance * units.of(Quantity::length)},
                    {"vertical_load", cycle.vertical_load * units.of(Quantity::force)},
                    {"indicated_error", json_of(cycle.indicated, units.of(Quantity::energy_norm))},
                    {"certified_relative", json_of(cycle.certified)}});
  return json;
}

/// The contact steps on the last mesh, by columns.
Json history_json(const Result& result) {
  Json json = {{"active", Json::array()}, {"changed", Json::array()}};
  for (const ContactStep& step : result.history) {
    json["active"].push_back(step.active);
    json["changed"].push_back(step.changed);
    if (step.residual)
      json["residual"].push_back(*step.residual);
  }
  return json;
}

} // namespace

std::string summary_json(const Scene& scene, const RunOptions& options, const Result& result) {
  Json json;
  json["program"] = version_text();
  if (const std::string missed = shortfall_text(result.notes); !missed.empty())
    json["shortfall"] = missed;
  if (const auto remarks = texts_of(result.notes, Note::Kind::remark); !remarks.empty())
    json["remarks"] = remarks;
  json["scene"] = scene_json(scene, options);
  add_quantities(result, scene.units, json);
  json["contact"]["patches"] = patches_json(result, scene.units);
  json["cycles"] = cycles_json(result, scene.units);
  json["iterations"]["method"] =
      options.contact.method == ContactMethod::uzawa ? "uzawa" : "active set";
  json["iterations"]["history"] = history_json(result);
  return json.dump(2) + "\n";
}

} // namespace rollwave
