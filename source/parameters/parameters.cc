#include "rollwave/parameters/parameters.h"

#include "rollwave/base/text.h"
#include "rollwave/parameters/keys.h"

#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace rollwave {

namespace {

/// Bounds of numbers that have no other.
constexpr double tiny = std::numeric_limits<double>::min();
constexpr double huge = std::numeric_limits<double>::max();
constexpr double most = std::numeric_limits<int>::max(); ///< of things that are counted
constexpr Range positive = {tiny, huge}, any_number = {-huge, huge};

void declare_cylinder(Section<CylinderOptions> keys) {
  keys.add("Inner radius", &CylinderOptions::inner_radius, positive,
           "Radius a of the rigid hub: a length, greater than 0 and at least 1e-150 b.",
           {Affects::titles, "a", Quantity::length});
  // Energies have the square of the unit of length.
  keys.add("Outer radius", &CylinderOptions::outer_radius, {1e-151, 1e151},
           "Radius b of the undeformed cylinder: a length from 1e-151 to 1e151, greater than a.",
           {Affects::titles, "b", Quantity::length});
  keys.add("Angular velocity", &CylinderOptions::angular_velocity, {0, huge},
           "Angular velocity omega of rolling: radians per unit of time, from 0 to the critical "
           "speed, (mu/rho)^(1/2)/b with mu and rho of section Material.",
           {Affects::titles, "omega", Quantity::angular_velocity});
  keys.declare(
      "Radial force", CylinderOptions().radial_force,
      [](Setting& setting) {
        return [force = setting.value](Parameters& p) { p.cylinder.radial_force = force; };
      },
      "Radial force f per unit of volume, positive outwards: an expression in r and z, a <= r "
      "<= b, 0 <= z < 2 pi, as in 1 + 0.5*r*cos(z) or if(r > 0.7 && z < 4, 1, 0). int and "
      "rint round to the nearest integer (int(1.7) is 2), floor down and ceil up.",
      {Affects::titles, "f"});
}

void declare_material(Section<MaterialOptions> keys) {
  constexpr Range range = {1e-30, 1e30};
  keys.add("Shear modulus", &MaterialOptions::shear_modulus, range,
           "Shear modulus mu: a pressure, from 1e-30 to 1e30, in any consistent system of units. "
           "With 1, pressures and forces are relative to the shear modulus.",
           {0, "mu", Quantity::pressure});
  keys.add("Density", &MaterialOptions::density, range,
           "Density rho: a mass per volume, from 1e-30 to 1e30. With density and shear modulus 1, "
           "the angular velocity is relative to the wave speed.",
           {0, "rho", Quantity::density});
  keys.add("Width", &MaterialOptions::width, range,
           "Width of the cylinder along its axle: a length, from 1e-30 to 1e30. With 1, forces, "
           "energies and stiffness are per unit of length of the axle.",
           {0, "", Quantity::length});
}

/// "auto" or two angles.
std::optional<std::pair<double, double>> convert_zone(Setting& setting) {
  if (setting.value == "auto")
    return {};
  auto angles = split(setting.value, ',');
  if (angles.size() != 2)
    throw std::invalid_argument("");
  const std::pair zone(convert_number(angles[0], any_number),
                       convert_number(angles[1], any_number));
  setting.value = angles[0] + ", " + angles[1];
  return zone;
}

void declare_road(Section<RoadOptions> keys) {
  keys.declare(
      "Distance", number_text(RoadOptions().distance),
      [](Setting& setting) {
        const double distance = setting.value == "none" ? RoadOptions().distance
                                                        : convert_number(setting.value, positive);
        return [=](Parameters& p) { p.road.distance = distance; };
      },
      "Distance c of the road below the axle: a length, greater than a; less than 2 b where the "
      "contact zone is auto. \"none\" where a load or a nip is given.",
      {Affects::titles, "c", Quantity::length});
  keys.add("Load", &RoadOptions::load, "none", positive,
           "\"none\", or instead of the distance the load on the whole width: a force, "
           "greater than 0. A file gives the distance, or load or nip; these replace the distance, "
           "and it replaces them, where the command line or a study gives them.",
           {0, "", Quantity::force});
  keys.add("Nip", &RoadOptions::nip, "none", positive,
           "\"none\", or instead of the distance the length of contact along the road: a length, "
           "greater than 0. With a load as well, both are one measurement: the shear modulus, and "
           "the density in the same ratio, are scaled until both hold.",
           {0, "", Quantity::length});
  keys.add_choice<LoadKind>(
      "Load kind", &RoadOptions::load_kind,
      {{"vertical", LoadKind::vertical}, {"total", LoadKind::total}},
      "The force that the load prescribes. \"vertical\": the force on the axle; \"total\": the "
      "integral of the pressure.");
  keys.add("Curvature", &RoadOptions::curvature, any_number,
           "Curvature kappa of the road: one over a length. 0: flat; positive: the outside of a "
           "drum; negative: the inside of a drum, with -1/kappa > b.",
           {0, "kappa", Quantity::curvature});
  keys.declare(
      "Contact zone", "auto",
      [](Setting& setting) {
        return [zone = convert_zone(setting)](Parameters& p) { p.road.contact_zone = zone; };
      },
      "The angles between which contact is possible: \"auto\" or two numbers \"z0, z1\" with "
      "pi < z0 < z1 < 2 pi, in radians; the lowest point is at 3 pi / 2. \"auto\": if "
      "the force is uniform, the angles at which the surface without contact would penetrate the "
      "road, and two cells more at each end; otherwise the angles at which the road is nearer than "
      "2 b to the axle, which is also the widest zone.",
      {0, "[z0, z1]"});
}

void declare_mesh(Section<RunOptions::Mesh> keys) {
  keys.add("Degree", &MeshOptions::degree, {1, highest_degree},
           "Polynomial degree of the elements, 1 to 8: 1 for Q1, 2 for Q2.", {Affects::titles});
  keys.add(
      "Radial cells", &MeshOptions::radial_cells, {1, most},
      "Cells from hub to surface, 1 to 2147483647: equal heights, graded near very small hubs, "
      "which have more cells if these are too few.",
      {Affects::resolution});
  keys.add("Angular cells", &MeshOptions::angular_cells, {3, most},
           "Cells around the ring, 3 to 2147483647.", {Affects::resolution});
  keys.add("Global refinements", &MeshOptions::global_refinements, {0, 20},
           "The number of times that every cell is cut into four, 0 to 20.", {Affects::resolution});
  keys.add("Adaptive cycles", &RefinementOptions::adaptive_cycles, "auto", {0, 1000},
           "The number of adaptive refinements after the global ones: 0 to 1000, or "
           "\"auto\": as many as the wanted relative error needs, 0 without one.",
           {Affects::resolution});
  keys.add("Wanted relative error", &RefinementOptions::wanted_relative_error, {0, 1},
           "Target of the certified error in the energy norm, relative to the solution: a number "
           "from 0 to 1, down to which the mesh is refined. 0: no target.",
           {Affects::resolution});
  keys.add_choice<Indicator>(
      "Indicator", &RefinementOptions::indicator,
      {{"certificate", Indicator::certificate}, {"kelly", Indicator::kelly}},
      "The indicator of the cells to refine. \"certificate\": each cell's share of the error "
      "bound. \"kelly\": jumps of the normal derivative, which are also taken where "
      "Certificate/Error bound is false.");
  keys.add_choice<Marking>(
      "Marking", &RefinementOptions::marking, {{"bulk", Marking::bulk}, {"all", Marking::all}},
      "Which cells to refine. \"bulk\": the fewest that hold the marked fraction of the squared "
      "error. \"all\": every cell.");
  keys.add("Marked fraction", &RefinementOptions::marked_fraction, {0.01, 1},
           "Fraction used by Marking = bulk, from 0.01 to 1. Fewer cells are marked where the "
           "certificate says that the wanted relative error needs fewer.");
  keys.add(
      "Most unknowns", &MeshOptions::most_unknowns, {1, most},
      "Largest number of unknowns, 1 to 2147483647: a larger mesh is refused; adaptive refinement "
      "ends below it.",
      {Affects::resolution});
}

void declare_certificate(Section<CertificateOptions> keys) {
  keys.add(
      "Error bound", &CertificateOptions::error_bound,
      "\"true\" or \"false\": compute a guaranteed bound of the error in the energy norm, "
      "with guaranteed intervals of the energy, the contact force and the vertical load; costs "
      "at most about another linear solve.");
}

void declare_contact(Section<ContactOptions> keys) {
  keys.add_choice<ContactMethod>(
      "Method", &ContactOptions::method,
      {{"active set", ContactMethod::active_set}, {"uzawa", ContactMethod::uzawa}},
      "The contact iteration. \"active set\": primal-dual active set, ends in finitely many steps. "
      "\"uzawa\": projected steps of length rho on the pressure. The distance for a given load or "
      "nip is searched by the active set in both cases.",
      {Affects::titles});
  keys.add("Rho", &ContactOptions::rho, "auto", positive,
           "Step length rho of Uzawa's method, a pressure over a displacement: a number "
           "greater than 0, or \"auto\": 1.8 over the largest eigenvalue of the "
           "compliance of the contact zone.",
           {Affects::uzawa, "ρ", Quantity::force_density});
  keys.add_choice<UzawaStop>(
      "Stopping rule", &ContactOptions::stop,
      {{"gap", UzawaStop::gap}, {"change", UzawaStop::change}},
      "The quantity that Uzawa's method compares with the tolerance, in the l2 norm over the "
      "contact nodes, relative to that of the displacement by contact. \"gap\": |change of the "
      "pressure| / rho, the violation of the contact conditions. \"change\": the change of u in "
      "one step, where the violation has to be at most the square root of the tolerance.",
      {Affects::uzawa});
  keys.add("Tolerance", &ContactOptions::tolerance, {1e-15, 0.1},
           "Relative tolerance of Uzawa's method, from 1e-15 to 0.1. The active set method ends "
           "when the set is right and needs none.",
           {Affects::uzawa});
  keys.add("Most steps", &ContactOptions::most_steps, {1, most},
           "Largest number of steps of the contact iteration, 1 to 2147483647.");
}

void apply(const std::vector<Assignment>& assignments, Parameters& parameters) {
  for (const Assignment& assignment : assignments) {
    assignment.assign(parameters);
    parameters.settings.push_back(assignment);
  }
}

/// Sets a key of Road to none.
void leave_out(const std::string& key, Setting setting, Parameters& parameters) {
  setting.key = key;
  setting.value = "none";
  apply({read(setting)}, parameters);
}

/// The later one of the distance and of load or nip holds; the others become none.
void settle_distance(Parameters& parameters) {
  std::optional<Setting> distance, load, nip;
  bool is_distance_later = false;
  for (const Setting& setting : parameters.settings) {
    std::optional<Setting>* const given = setting.path() == "Road/Distance" ? &distance
                                          : setting.path() == "Road/Load"   ? &load
                                          : setting.path() == "Road/Nip"    ? &nip
                                                                            : nullptr;
    if (!given)
      continue;
    *given = setting.value == "none" ? std::nullopt : std::optional(setting);
    if (*given)
      is_distance_later = given == &distance;
  }
  if (!distance && !load && !nip) {
    if (const Setting* const none = last_of(parameters.settings, "Road/Distance"))
      throw BadInput(refusal(*none, "\"none\" needs a load or a nip: set Road/Load or Road/Nip"));
    return;
  }
  for (const auto& other : {load, nip})
    if (distance && other && distance->origin == other->origin)
      throw BadInput(refusal(*other,
                             "a distance is given as well; leave out one of them, or set it "
                             "to none"));
  if (!is_distance_later)
    leave_out("Distance", load ? *load : *nip, parameters);
  else if (distance)
    for (const char* const key : {"Load", "Nip"})
      leave_out(key, *distance, parameters);
}

} // namespace

const std::vector<Key>& all_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> keys;
    declare_cylinder({keys, "Cylinder", &Parameters::cylinder, Affects::scene});
    declare_material({keys, "Material", &Parameters::material, Affects::scene});
    declare_road({keys, "Road", &Parameters::road, Affects::scene});
    declare_mesh({keys, "Mesh", &Parameters::mesh});
    declare_certificate({keys, "Certificate", &Parameters::certificate});
    declare_contact({keys, "Contact", &Parameters::contact});
    declare_study({keys, "Study", &Parameters::study});
    declare_output({keys, "Output", &Parameters::output});
    return keys;
  }();
  return all;
}

Parameters with_values(Parameters parameters, const std::vector<Assignment>& assignments) {
  apply(assignments, parameters);
  settle_distance(parameters);
  return parameters;
}

Parameters read_parameters(const std::vector<Setting>& settings) {
  std::vector<Assignment> assignments;
  for (const Setting& setting : settings)
    assignments.push_back(read(setting));
  const Parameters parameters = with_values({}, assignments);
  check_scenes(parameters.study);
  return parameters;
}

} // namespace rollwave
