#include "rollwave/parameters/parameters.h"

#include "rollwave/base/errors.h"
#include "rollwave/parameters/declarations.h"

#include <algorithm>
#include <limits>
#include <map>
#include <ostream>
#include <set>

namespace rollwave {

namespace {

std::optional<std::pair<double, double>> parse_zone(const std::string& text) {
  if (text == "auto")
    return {};
  const auto ends = split(text, ',');
  if (ends.size() != 2)
    throw std::invalid_argument("two numbers with a comma between them, whose decimal mark is a "
                                "point, as in 4.2, 5.2");
  return std::pair(to_number(ends[0]), to_number(ends[1]));
}

/// Bounds of numbers that have no other.
constexpr double tiny = std::numeric_limits<double>::min();
constexpr double huge = std::numeric_limits<double>::max();
constexpr unsigned int most = std::numeric_limits<int>::max();

void declare_cylinder(Declarations& keys, Parameters& p) {
  keys.enter("Cylinder");
  keys.add_number("Inner radius", p.cylinder.inner_radius, tiny, huge,
                  "Radius a of the rigid hub: a length, greater than 0, at least 1e-150 of b.");
  // Energies have the square of the unit of length.
  keys.add_number("Outer radius", p.cylinder.outer_radius, 1e-151, 1e151,
                  "Radius b of the undeformed cylinder: a length, greater than a, from 1e-151 to "
                  "1e151.");
  keys.add_number(
      "Angular velocity", p.cylinder.angular_velocity, 0, huge,
      "Angular velocity omega of rolling, in radians for each unit of time, from 0 to the critical "
      "speed, (mu/rho)^(1/2)/b in terms of Material.");
  keys.add_text(
      "Radial force", p.cylinder.radial_force,
      "Radial force f for each unit of volume: an expression in r and z, a <= r <= b, 0 <= z < "
      "2 pi.");
}

void declare_material(Declarations& keys, Parameters& p) {
  constexpr double smallest = 1e-30, largest = 1e30;
  keys.enter("Material");
  keys.add_number("Shear modulus", p.material.shear_modulus, smallest, largest,
                  "Shear modulus mu: a pressure, from 1e-30 to 1e30, in any consistent system of "
                  "units. With 1 here, pressures and forces are over the shear modulus.");
  keys.add_number("Density", p.material.density, smallest, largest,
                  "Density rho: a mass over a volume, from 1e-30 to 1e30. With a density of 1 and "
                  "a shear modulus of 1 the angular velocity is over the wave speed.");
  keys.add_number(
      "Width", p.material.width, smallest, largest,
      "Width of the cylinder along its axle: a length, from 1e-30 to 1e30. With 1 here, "
      "forces, energies and stiffness are for each unit of the axle's length.");
}

void declare_road(Declarations& keys, Parameters& p) {
  keys.enter("Road");
  keys.add(
      "Distance", "0.8",
      [&p](const std::string& text) {
        if (text != "none" && !((p.road.distance = to_number(text)) > 0))
          throw std::invalid_argument("");
      },
      "Distance c of the road below the axle: a length, greater than a; less than 2 b where the "
      "zone is auto. \"none\" where a load is given.");
  keys.add(
      "Load", "none",
      [&p](const std::string& text) {
        p.road.load = text == "none" ? std::nullopt : std::optional(to_number(text));
        if (p.road.load && !(*p.road.load > 0))
          throw std::invalid_argument("");
      },
      "\"none\", or instead of the distance the load on the whole width: a force, greater than 0.");
  keys.add_choice<LoadKind>(
      "Load kind", p.road.load_kind,
      {{"vertical", LoadKind::vertical},
       {"total", LoadKind::total},
       {"work-conjugate", LoadKind::work_conjugate}},
      "What the load is: \"vertical\", what the axle carries; \"total\", the integral of the "
      "pressure; \"work-conjugate\", what does work when the distance changes.");
  keys.add_number("Curvature", p.road.curvature, -huge, huge,
                  "Curvature kappa of the road: one over a length; 0 is flat, positive the outside "
                  "of a drum, negative the inside of one with -1/kappa > b.");
  keys.add(
      "Contact zone", "auto",
      [&p](const std::string& text) { p.road.contact_zone = parse_zone(text); },
      "The angles between which contact is possible: \"auto\" or two numbers \"z0, z1\" with "
      "pi < z0 < z1 < 2 pi, in radians; the lowest point is at 3 pi / 2. \"auto\" is where the "
      "surface without contact would be beyond the road, and two cells more, but never beyond "
      "phi < b; where the force is not uniform, it is where phi < b.");
}

void declare_mesh(Declarations& keys, Parameters& p) {
  keys.enter("Mesh");
  keys.add_count("Degree", p.mesh.degree, 1, highest_degree,
                 "Polynomial degree of the elements, 1 to 8: 1 for Q1, 2 for Q2.");
  keys.add_count(
      "Radial cells", p.mesh.radial_cells, 1, most,
      "Cells from hub to surface, 1 or more: of equal heights, which grow with the radius next "
      "to a hub that is smaller than they would be.");
  keys.add_count("Angular cells", p.mesh.angular_cells, 3, most, "Cells around, 3 or more.");
  keys.add_count("Global refinements", p.mesh.global_refinements, 0, 20,
                 "How often every cell is cut into four, 0 to 20.");
  keys.add(
      "Adaptive cycles", "auto",
      [&p](const std::string& text) {
        p.mesh.adaptive_cycles =
            text == "auto" ? std::nullopt : std::optional(to_count(text, 0, 1000));
      },
      "How often the mesh is refined where the error is, after the global refinements: a number "
      "from 0 to 1000 or \"auto\", as often as the wanted relative error needs, which is never "
      "when "
      "none is wanted.");
  keys.add_number("Wanted relative error", p.mesh.wanted_relative_error, 0, 1,
                  "Refine until the certified error in the energy norm, relative to the solution, "
                  "is no larger than this number, from 0 to 1; 0 for no such wish.");
  keys.add_choice<Indicator>(
      "Indicator", p.mesh.indicator,
      {{"certificate", Indicator::certificate}, {"kelly", Indicator::kelly}},
      "What tells where to refine. \"certificate\": each cell's share of the error bound. "
      "\"kelly\": jumps of the normal derivative, which are also taken where "
      "Certificate/Error bound is false.");
  keys.add_choice<Marking>(
      "Marking", p.mesh.marking, {{"bulk", Marking::bulk}, {"all", Marking::all}},
      "Which cells to refine. \"bulk\": the fewest that hold the marked fraction of the squared "
      "error. \"all\": every cell.");
  keys.add_number("Marked fraction", p.mesh.marked_fraction, 0.01, 1,
                  "The fraction for Marking = bulk, from 0.01 to 1.");
  keys.add_count("Most unknowns", p.mesh.most_unknowns, 1, most,
                 "A mesh with more unknowns than this number is refused; adaptive refinement ends "
                 "below it.");
}

void declare_certificate(Declarations& keys, Parameters& p) {
  keys.enter("Certificate");
  keys.add_flag("Error bound", p.certificate.error_bound,
                "whether to compute a guaranteed bound of the error "
                "in the energy norm, with bounds of the energy from both sides; costs "
                "at most about another linear solve.");
  keys.add_flag("Load bounds", p.certificate.load_bounds,
                "whether to bound the work-conjugate load G from "
                "both sides, by the certified energies of two more road distances; costs "
                "two more scenes on the last mesh.");
}

void declare_contact(Declarations& keys, Parameters& p) {
  keys.enter("Contact");
  keys.add_choice<ContactMethod>(
      "Method", p.contact.method,
      {{"active set", ContactMethod::active_set}, {"uzawa", ContactMethod::uzawa}},
      "The contact iteration. \"active set\": primal-dual active set, ends in finitely many steps. "
      "\"uzawa\": projected steps of length rho on the pressure.");
  keys.add(
      "Rho", "auto",
      [&p](const std::string& text) {
        p.contact.rho = text == "auto" ? std::nullopt : std::optional(to_number(text));
        if (p.contact.rho && *p.contact.rho <= 0)
          throw std::invalid_argument("");
      },
      "Uzawa's step length rho, a pressure over a displacement: \"auto\" or a number greater than "
      "0. "
      "\"auto\" is 1.8 over the largest eigenvalue of the compliance of the contact zone.");
  keys.add_choice<UzawaStop>(
      "Stopping rule", p.contact.stop, {{"gap", UzawaStop::gap}, {"change", UzawaStop::change}},
      "What Uzawa compares with the tolerance, in the l2 norm over the contact nodes, relative to "
      "that of u. \"gap\": |p_new - p| / rho, how far the contact conditions are violated. "
      "\"change\": the change of u in one step.");
  keys.add_number("Tolerance", p.contact.tolerance, 1e-15, 0.1,
                  "Where Uzawa stops: a relative number from 1e-15 to 0.1. The active set method "
                  "ends when the set is right and needs none.");
  keys.add_count("Most steps", p.contact.most_steps, 1, most,
                 "The contact iteration gives up after this number of steps, 1 or more.");
}

void declare_solver(Declarations& keys, Parameters& p) {
  keys.enter("Solver");
  keys.add_choice<SolverKind>(
      "Kind", p.solver.kind,
      {{"auto", SolverKind::automatic},
       {"direct", SolverKind::direct},
       {"iterative", SolverKind::iterative}},
      "How linear problems are solved. \"direct\": one sparse Cholesky factorisation for each "
      "mesh. \"iterative\": conjugate gradients with algebraic multigrid, slower but with less "
      "memory. \"auto\": \"direct\", or \"iterative\" where the factor does not fit into memory.");
}

/// Every key of the program: name, default, range, unit and text, each in one statement.
void declare(Declarations& keys, Parameters& p) {
  declare_cylinder(keys, p);
  declare_material(keys, p);
  declare_road(keys, p);
  declare_mesh(keys, p);
  declare_certificate(keys, p);
  declare_contact(keys, p);
  declare_solver(keys, p);
  declare_study(keys, p.study);
  declare_output(keys, p.output, p.material.unit_names);
}

/// Keys of earlier versions, which say what to do instead.
void refuse_gone(const std::vector<Setting>& settings) {
  const std::map<std::string, std::string> gone = {
      {"Study/Continue meshes", "adaptive runs begin anew"},
      {"Study/Reference unknowns",
       "where no exact solution is known, the certified error is given"}};
  for (const Setting& setting : settings)
    if (const auto key = gone.find(setting.path()); key != gone.end())
      throw BadInput(place(setting) + ": this key is gone; " + key->second + "; leave the key out");
}

/// The setting that holds for a key; nullptr where there is none.
const Setting* last_of(const std::vector<Setting>& settings, const std::string& path) {
  const auto last = std::find_if(settings.rbegin(), settings.rend(),
                                 [&](const Setting& setting) { return setting.path() == path; });
  return last == settings.rend() ? nullptr : &*last;
}

} // namespace

Parameters read_parameters(const std::vector<Setting>& settings) {
  Parameters parameters;
  Declarations keys;
  declare(keys, parameters);
  refuse_gone(settings);
  keys.apply(settings);
  parameters.settings = settings;
  const Setting* const distance = last_of(settings, "Road/Distance");
  const bool has_distance = distance && distance->value != "none";
  if (parameters.road.load && has_distance)
    throw BadInput(refusal(settings, "Road", "Load",
                           "the distance follows from the load; leave Road/Distance out, or set it "
                           "or Road/Load to none"));
  if (!parameters.road.load && distance && !has_distance)
    throw BadInput(
        refusal(settings, "Road", "Distance", "without a distance Road/Load must be given"));
  for (const Setting& setting : settings) {
    const auto set_origin = [&](const std::string& key, Setting& value) {
      if (setting.path() == key)
        value.origin = setting.origin + ", " + key;
      keys.check_key(value);
    };
    for (Variation& variation : parameters.study.vary)
      for (auto& choice : variation)
        for (Setting& value : choice)
          set_origin("Study/Vary", value);
    for (auto& scene : parameters.study.scenes)
      for (Setting& value : scene.settings)
        set_origin("Study/Scenes", value);
  }
  return parameters;
}

std::string refusal(const std::vector<Setting>& settings, const std::string& section,
                    const std::string& key, const std::string& wanted) {
  const Setting* const last = last_of(settings, section + '/' + key);
  if (!last)
    return place({section, key, "", "default value"}) + ": " + wanted;
  return place(*last) + ", value " + in_quotes(last->value) + ": " + wanted;
}

std::string refusal(const std::vector<Setting>& settings, const BadValue& value) {
  return refusal(settings, value.section, value.key, value.wanted);
}

void print_parameters(std::ostream& out, const std::vector<Setting>& settings) {
  Parameters parameters;
  Declarations keys;
  declare(keys, parameters);
  keys.apply(settings);
  if (parameters.road.load)
    keys.apply({{"Road", "Distance", "none", "Road/Load"}});
  keys.print(out);
}

} // namespace rollwave
