#include "rollwave/output/summary_json.h"

#include "rollwave/base/version.h"
#include "rollwave/scene/units.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace rollwave {

namespace {

using Json = nlohmann::ordered_json;

/// What is not finite becomes null as well.
Json number_or_null(bool exists, double number) {
  return exists ? Json(number) : Json(nullptr);
}

void add_scene_and_mesh(const Scene& scene, const RunOptions& options, const Result& result,
                        Json& json) {
  json["scene"] = {{"inner_radius", options.cylinder.inner_radius},
                   {"outer_radius", options.cylinder.outer_radius},
                   {"angular_velocity", options.cylinder.angular_velocity},
                   {"road_distance", result.road_distance},
                   {"road_curvature", options.road.curvature},
                   {"radial_force", options.cylinder.radial_force},
                   {"zone_begin", scene.zone_begin},
                   {"zone_end", scene.zone_end}};
  const MaterialOptions& material = options.material;
  const auto& names = material.unit_names;
  if (material.is_given())
    json["scene"]["material"] = {{"shear_modulus", material.shear_modulus},
                                 {"density", material.density},
                                 {"width", material.width}};
  if (!names.length.empty())
    json["scene"]["unit_names"] = {
        {"length", names.length}, {"time", names.time}, {"force", names.force}};
  json["mesh"] = {{"degree", result.mesh.degree}, {"cells", result.mesh.cells},
                  {"dofs", result.mesh.dofs},     {"contact_nodes", result.mesh.contact_nodes},
                  {"h_min", result.mesh.h_min},   {"h_max", result.mesh.h_max}};
}

void add_contact(const Result& result, Json& json) {
  const ContactResultants& patch = result.patch;
  const auto [left, right] = patch.ends.value_or(std::pair(0., 0.));
  json["contact"] = {{"left_end", number_or_null(patch.ends.has_value(), left)},
                     {"right_end", number_or_null(patch.ends.has_value(), right)},
                     {"half_width", number_or_null(patch.patches.size() < 2, patch.half_width())},
                     {"force", patch.force},
                     {"vertical_load", patch.vertical_load},
                     {"work_conjugate_load", patch.work_conjugate_load},
                     {"peak_pressure", patch.peak_pressure},
                     {"active_nodes", patch.active_nodes}};
  json["contact"]["stiffness"] = {{"force", patch.stiffness.total},
                                  {"vertical_load", patch.stiffness.vertical},
                                  {"work_conjugate_load", patch.stiffness.work_conjugate}};
  json["contact"]["patches"] = Json::array();
  for (const ContactPatch& stretch : patch.patches)
    json["contact"]["patches"].push_back({{"left_end", stretch.begin},
                                          {"right_end", stretch.end},
                                          {"length", stretch.length},
                                          {"force", stretch.force},
                                          {"centroid", stretch.centroid},
                                          {"peak_pressure", stretch.peak_pressure}});
  if (result.distance_bounds) {
    json["contact"]["distance_lower_bound"] = result.distance_bounds->lower;
    json["contact"]["distance_upper_bound"] = result.distance_bounds->upper;
  }
  if (result.load_bounds) {
    json["contact"]["work_conjugate_load_lower_bound"] = result.load_bounds->lower;
    json["contact"]["work_conjugate_load_upper_bound"] = result.load_bounds->upper;
  }
}

void add_energy_and_errors(const Result& result, Json& json) {
  json["energy"] = {{"value", result.energy.value}, {"norm_squared", result.energy.norm_squared}};
  if (result.certified) {
    json["energy"]["lower_bound"] = result.certified->lower_bound;
    json["energy"]["upper_bound"] = result.certified->upper_bound;
    json["error"]["force_data"] = result.certified->force_data;
    json["error"]["certified_energy_norm"] = result.certified->energy_norm;
    json["error"]["certified_relative"] = result.certified->relative;
    const double width = result.certified->sampled_width;
    json["error"]["force_sampled_width"] = number_or_null(width > 0, width);
  }
  if (result.errors) {
    Json& error = json["error"];
    if (result.errors->is_resolved) {
      error["exact_energy_norm"] = result.errors->energy_norm;
      error["exact_relative"] = result.errors->relative_energy_norm;
    }
    error["exact_l2_norm"] = result.errors->l2_norm;
    error["exact_pressure"] = result.errors->pressure;
    error["exact_force"] = result.errors->force;
    error["exact_energy"] = result.errors->energy;
    error["exact_half_width"] = result.errors->half_width;
    if (result.errors->exact_distance)
      error["exact_distance"] = std::abs(*result.errors->exact_distance - result.road_distance);
    if (result.errors->admissible_energy_norm) {
      if (result.errors->is_resolved)
        error["exact_feasible_energy_norm"] = *result.errors->admissible_energy_norm;
      if (result.errors->effectivity)
        error["effectivity"] = *result.errors->effectivity;
    }
  }
  json["residuals"] = {{"equilibrium", result.residuals.equilibrium},
                       {"penetration", result.residuals.penetration},
                       {"negative_pressure", result.residuals.negative_pressure},
                       {"complementarity", result.residuals.complementarity},
                       {"round_off", result.residuals.round_off}};
}

void add_cycles(const RunOptions& options, const Result& result, Json& json) {
  for (const CycleFigures& cycle : result.cycles)
    json["cycles"].push_back(
        {{"cells", cycle.cells},
         {"dofs", cycle.dofs},
         {"contact_steps", cycle.contact_steps},
         {"indicated_error", number_or_null(cycle.indicated > 0, cycle.indicated)},
         {"certified_relative",
          number_or_null(cycle.certified.has_value(), cycle.certified.value_or(0))}});

  const bool is_uzawa = options.contact.method == ContactMethod::uzawa;
  json["iterations"] = {{"method", is_uzawa ? "uzawa" : "active set"},
                        {"contact", result.history.size()},
                        {"linear", result.work.linear_iterations}};
  if (is_uzawa)
    json["iterations"]["rho"] = result.rho;
}

void add_work(const Work& work, Json& json) {
  json["work"] = {{"load_assemblies", work.load_assemblies},
                  {"stiffness_assemblies", work.stiffness_assemblies},
                  {"orderings", work.orderings},
                  {"factorisations", work.factorisations},
                  {"diagonalisations", 0},
                  {"dense_factorisations", work.dense_factorisations},
                  {"forward_substitutions", work.forward_substitutions},
                  {"back_substitutions", work.back_substitutions},
                  {"preconditioners", work.preconditioners},
                  {"bytes_written", work.bytes_written}};
  for (const auto& [phase, seconds] : work.seconds())
    json["seconds"][phase] = seconds;
  json["seconds"]["total"] = work.total_seconds();
}

} // namespace

std::string summary_json(const Scene& scene, const RunOptions& options, const Result& result) {
  Json json;
  json["program"] = version_text();
  if (!result.shortfalls.empty())
    json["shortfall"] = shortfall_text(result);
  add_scene_and_mesh(scene, options, result, json);
  add_contact(result, json);
  add_energy_and_errors(result, json);
  add_cycles(options, result, json);
  if (!result.remarks.empty())
    json["remarks"] = result.remarks;

  add_work(result.work, json);
  json["peak_memory_mib"] = result.peak_memory_mib;
  return json.dump(2) + "\n";
}

} // namespace rollwave
