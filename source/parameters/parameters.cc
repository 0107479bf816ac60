#include "rollwave/parameters/parameters.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/keys.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <ostream>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/// Bounds of numbers that have no other.
constexpr double tiny = std::numeric_limits<double>::min();
constexpr double huge = std::numeric_limits<double>::max();

void declare_cylinder(Keys& keys, CylinderOptions& cylinder) {
  keys.enter("Cylinder", Affects::scene);
  keys.add("Inner radius", cylinder.inner_radius, Patterns::Double(tiny, huge),
           "Radius a of the rigid hub: a length, greater than 0 and at least 1e-150 b.",
           {Affects::mesh | Affects::titles, "a", Quantity::length});
  // Energies have the square of the unit of length.
  keys.add("Outer radius", cylinder.outer_radius, Patterns::Double(1e-151, 1e151),
           "Radius b of the undeformed cylinder: a length from 1e-151 to 1e151, greater than a.",
           {Affects::mesh | Affects::titles, "b", Quantity::length});
  keys.add("Angular velocity", cylinder.angular_velocity, Patterns::Double(0, huge),
           "Angular velocity omega of rolling: radians per unit of time, from 0 to the critical "
           "speed, (mu/rho)^(1/2)/b with mu and rho of section Material.",
           {Affects::titles, "ω", Quantity::angular_velocity});
  keys.add("Radial force", cylinder.radial_force, Patterns::Anything(),
           "Radial force f per unit of volume, positive outwards: an expression in r and z, a <= r "
           "<= b, 0 <= z < 2 pi, as in 1 + 0.5*r*cos(z) or if(r > 0.7 && z < 4, 1, 0). int and "
           "rint round to the nearest integer (int(1.7) is 2), floor down and ceil up.",
           {Affects::titles, "f"});
}

void declare_material(Keys& keys, MaterialOptions& material) {
  const Patterns::Double range(1e-30, 1e30);
  keys.enter("Material", Affects::scene);
  keys.add("Shear modulus", material.shear_modulus, range,
           "Shear modulus mu: a pressure, from 1e-30 to 1e30, in any consistent system of units. "
           "With 1, pressures and forces are relative to the shear modulus.",
           {0, "μ", Quantity::pressure});
  keys.add("Density", material.density, range,
           "Density rho: a mass per volume, from 1e-30 to 1e30. With density and shear modulus 1, "
           "the angular velocity is relative to the wave speed.",
           {0, "", Quantity::density});
  keys.add("Width", material.width, range,
           "Width of the cylinder along its axle: a length, from 1e-30 to 1e30. With 1, forces, "
           "energies and stiffness are per unit of length of the axle.",
           {0, "", Quantity::length});
}

void declare_road(Keys& keys, RoadOptions& road) {
  const Patterns::Double positive(tiny, huge);
  keys.enter("Road", Affects::scene);
  keys.declare(
      "Distance", "0.8",
      [&road, positive](const Setting& setting) {
        if (setting.value != "none")
          road.distance = converted<double>(setting.value, positive);
      },
      "Distance c of the road below the axle: a length, greater than a; less than 2 b where the "
      "contact zone is auto. \"none\" where a load is given.",
      {Affects::titles, "c", Quantity::length});
  keys.add("Load", road.load, "none", positive,
           "\"none\", or instead of the distance the load on the whole width: a force, "
           "greater than 0. A file gives the distance or the load; either one replaces "
           "the other where the command line or a study gives it.",
           {0, "", Quantity::force});
  keys.add_choice<LoadKind>(
      "Load kind", road.load_kind,
      {{"vertical", LoadKind::vertical},
       {"total", LoadKind::total},
       {"work-conjugate", LoadKind::work_conjugate}},
      "The force that the load prescribes. \"vertical\": the force on the axle; \"total\": the "
      "integral of the pressure; \"work-conjugate\": the force that does work when the distance "
      "changes.");
  keys.add("Curvature", road.curvature, Patterns::Double(),
           "Curvature kappa of the road: one over a length. 0: flat; positive: the outside of a "
           "drum; negative: the inside of a drum, with -1/kappa > b.",
           {0, "κ"});
  keys.add(
      "Contact zone", road.contact_zone, "auto",
      Patterns::Tuple(",", Patterns::Double(), Patterns::Double()),
      "The angles between which contact is possible: \"auto\" or two numbers \"z0, z1\" with "
      "pi < z0 < z1 < 2 pi, in radians; the lowest point is at 3 pi / 2. \"auto\": if "
      "the force is uniform, the angles at which the surface without contact would penetrate the "
      "road, and two cells more at each end; otherwise the angles at which the road is nearer than "
      "2 b to the axle, which is also the widest zone.",
      {Affects::mesh, "[z0, z1]"});
}

void declare_mesh(Keys& keys, Parameters& p) {
  keys.enter("Mesh", Affects::mesh);
  keys.add("Degree", p.mesh.degree, Patterns::Integer(1, highest_degree),
           "Polynomial degree of the elements, 1 to 8: 1 for Q1, 2 for Q2.", {Affects::titles});
  keys.add("Radial cells", p.mesh.radial_cells, Patterns::Integer(1),
           "Cells from hub to surface, 1 or more: equal heights, graded near very small hubs.",
           {Affects::resolution});
  keys.add("Angular cells", p.mesh.angular_cells, Patterns::Integer(3),
           "Cells around the ring, 3 or more.", {Affects::resolution});
  keys.add("Global refinements", p.mesh.global_refinements, Patterns::Integer(0, 20),
           "The number of times that every cell is cut into four, 0 to 20.", {Affects::resolution});
  keys.add("Adaptive cycles", p.mesh.adaptive_cycles, "auto", Patterns::Integer(0, 1000),
           "The number of adaptive refinements after the global ones: 0 to 1000, or "
           "\"auto\": as many as the wanted relative error needs, 0 without one.",
           {Affects::resolution});
  keys.add("Wanted relative error", p.mesh.wanted_relative_error, Patterns::Double(0, 1),
           "Target of the certified error in the energy norm, relative to the solution: a number "
           "from 0 to 1, down to which the mesh is refined. 0: no target.",
           {Affects::resolution});
  keys.add_choice<Indicator>(
      "Indicator", p.mesh.indicator,
      {{"certificate", Indicator::certificate}, {"kelly", Indicator::kelly}},
      "The indicator of the cells to refine. \"certificate\": each cell's share of the error "
      "bound. "
      "\"kelly\": jumps of the normal derivative, which are also taken where "
      "Certificate/Error bound is false.");
  keys.add_choice<Marking>(
      "Marking", p.mesh.marking, {{"bulk", Marking::bulk}, {"all", Marking::all}},
      "Which cells to refine. \"bulk\": the fewest that hold the marked fraction of the squared "
      "error. \"all\": every cell.");
  keys.add("Marked fraction", p.mesh.marked_fraction, Patterns::Double(0.01, 1),
           "Fraction used by Marking = bulk, from 0.01 to 1.");
  keys.add("Most unknowns", p.mesh.most_unknowns, Patterns::Integer(1),
           "Largest number of unknowns, 1 or more: a larger mesh is refused; adaptive refinement "
           "ends below it.",
           {Affects::resolution});
}

void declare_certificate(Keys& keys, CertificateOptions& certificate) {
  keys.enter("Certificate", 0);
  keys.add(
      "Error bound", certificate.error_bound, Patterns::Bool(),
      "\"true\" or \"false\": compute a guaranteed bound of the error in the energy norm, "
      "with guaranteed intervals of the energy, the contact force and the vertical load; costs "
      "at most about another linear solve.");
}

void declare_contact(Keys& keys, ContactOptions& contact) {
  keys.enter("Contact", 0);
  keys.add_choice<ContactMethod>(
      "Method", contact.method,
      {{"active set", ContactMethod::active_set}, {"uzawa", ContactMethod::uzawa}},
      "The contact iteration. \"active set\": primal-dual active set, ends in finitely many steps. "
      "\"uzawa\": projected steps of length rho on the pressure.",
      {Affects::titles});
  keys.add("Rho", contact.rho, "auto", Patterns::Double(tiny, huge),
           "Step length rho of Uzawa's method, a pressure over a displacement: a number "
           "greater than 0, or \"auto\": 1.8 over the largest eigenvalue of the "
           "compliance of the contact zone.",
           {Affects::uzawa, "ρ", Quantity::force_density});
  keys.add_choice<UzawaStop>(
      "Stopping rule", contact.stop, {{"gap", UzawaStop::gap}, {"change", UzawaStop::change}},
      "The quantity that Uzawa's method compares with the tolerance, in the l2 norm over the "
      "contact nodes, relative to that of u. \"gap\": |change of the pressure| / rho, the "
      "violation of the "
      "contact conditions. \"change\": the change of u in one step.",
      {Affects::uzawa});
  keys.add("Tolerance", contact.tolerance, Patterns::Double(1e-15, 0.1),
           "Relative tolerance of Uzawa's method, from 1e-15 to 0.1. The active set method ends "
           "when the set is right and needs none.",
           {Affects::uzawa});
  keys.add("Most steps", contact.most_steps, Patterns::Integer(1),
           "Largest number of steps of the contact iteration, 1 or more.");
}

void declare_solver(Keys& keys, SolverOptions& solver) {
  keys.enter("Solver", Affects::mesh);
  keys.add_choice<SolverKind>(
      "Kind", solver.kind,
      {{"auto", SolverKind::automatic},
       {"direct", SolverKind::direct},
       {"iterative", SolverKind::iterative}},
      "The linear solver. \"direct\": one sparse Cholesky factorisation for each mesh. "
      "\"iterative\": conjugate gradients with algebraic multigrid, slower but with less memory. "
      "\"auto\": \"direct\"; \"iterative\" on several processes, for very many contact nodes and "
      "when memory is short.");
}

/// Declares every key: name, variable, range, unit and text, each in one statement.
void declare(Keys& keys, Parameters& p) {
  declare_cylinder(keys, p.cylinder);
  declare_material(keys, p.material);
  declare_road(keys, p.road);
  declare_mesh(keys, p);
  declare_certificate(keys, p.certificate);
  declare_contact(keys, p.contact);
  declare_solver(keys, p.solver);
  declare_study(keys, p.study);
  declare_output(keys, p.output, p.material.unit_names);
}

/// Parameters with their keys.
struct KeysOfParameters {
  Parameters parameters;
  Keys keys{parameters.settings};

  KeysOfParameters() { declare(keys, parameters); }
  void set(const std::vector<Setting>& settings);
};

/// The last setting of a key of section Road, nullptr without one or for "none".
const Setting* last_unless_none(const std::vector<Setting>& settings, const char* key) {
  const Setting* const last = last_of(settings, std::string("Road/") + key);
  return last && last->value != "none" ? last : nullptr;
}

[[noreturn]] void refuse_distance_and_load(const std::vector<Setting>& settings) {
  throw BadInput(refusal(settings, BadValue("Road", "Load",
                                            "a distance and a load are given; leave out one "
                                            "of them, or set it to none")));
}

/// The later one of distance and load holds; the other is set to none.
void KeysOfParameters::set(const std::vector<Setting>& settings) {
  for (const Setting& setting : settings)
    keys.set(setting);
  const Setting* const distance = last_unless_none(settings, "Distance");
  const Setting* const load = last_unless_none(settings, "Load");
  if (!distance && !load && last_of(settings, "Road/Distance"))
    throw BadInput(
        refusal(settings, BadValue("Road", "Distance", "\"none\" needs a load: set Road/Load")));
  if (distance && load && distance->origin == load->origin)
    refuse_distance_and_load(settings);
  if (load && (!distance || load > distance)) // later in the vector of settings
    keys.set({"Road", "Distance", "none", load->origin});
  else if (load)
    keys.set({"Road", "Load", "none", distance->origin});
}

} // namespace

const std::vector<Key>& all_keys() {
  static const std::vector<Key> all = KeysOfParameters().keys.all();
  return all;
}

const Key& key_of(const Setting& setting) {
  return *std::find_if(all_keys().begin(), all_keys().end(), [&](const Key& key) {
    return key.section == setting.section && key.name == setting.key;
  });
}

std::string value_of(const Key& key, const std::vector<Setting>& settings) {
  const Setting* const last = last_of(settings, key.path());
  return last ? last->value : key.default_value;
}

std::vector<Setting> parse_settings(const std::string& text, const std::string& name) {
  KeysOfParameters read;
  read.keys.read(text, name);
  const std::vector<Setting>& settings = read.parameters.settings;
  if (last_unless_none(settings, "Distance") && last_unless_none(settings, "Load"))
    refuse_distance_and_load(settings);
  return settings;
}

std::vector<Setting> read_settings(const std::filesystem::path& file, MPI_Comm communicator) {
  const std::string name = file.string();
  std::ostringstream text;
  if (process_number(communicator) == 0) {
    std::ifstream in(file);
    in.peek(); // fails for a directory
    if (!in.is_open() || in.bad())
      throw BadInput(printable(name) +
                     ": this parameter file cannot be read: " + std::strerror(errno));
    text << in.rdbuf();
  }
  return parse_settings(broadcast(communicator, text.str()), name);
}

Parameters read_parameters(const std::vector<Setting>& settings) {
  KeysOfParameters read;
  read.set(settings);
  return read.parameters;
}

void print_parameters(std::ostream& out, const std::vector<Setting>& settings) {
  KeysOfParameters read;
  read.set(settings);
  read.keys.print(out);
}

} // namespace rollwave
