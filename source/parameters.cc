#include "parameters.h"

#include "errors.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <ostream>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/// @p text as a finite number, in the C locale; subnormal numbers are refused as well.
/// @throws std::invalid_argument when it is none.
double to_number(const std::string& text) {
  std::size_t length = 0;
  double value = 0;
  try {
    value = std::stod(text, &length);
  } catch (const std::out_of_range&) {
    throw std::invalid_argument(text);
  }
  if (length == 0 || length != text.size() || !std::isfinite(value))
    throw std::invalid_argument(text);
  return value;
}

/// @p text as a whole number from @p least to @p most. @throws std::invalid_argument otherwise.
unsigned int to_count(const std::string& text, unsigned int least, unsigned int most) {
  const double number = to_number(text);
  if (number != std::floor(number) || number < least || number > most)
    throw std::invalid_argument(text);
  return static_cast<unsigned int>(number);
}

/// Declares the keys of one ParameterHandler and remembers their texts for messages.
class Declarations {
public:
  explicit Declarations(ParameterHandler& prm) : prm(prm) {}

  void enter(const std::string& name) {
    section = name;
    prm.enter_subsection(name);
  }

  void leave() { prm.leave_subsection(); }

  /// A key whose text is turned into a value by @p parse, which throws on a text not admitted.
  void add(const std::string& key, const std::string& default_text,
           const std::function<void(const std::string&)>& parse, const std::string& text) {
    prm.declare_entry(key, default_text, Patterns::Anything(), text);
    prm.add_action(key, parse);
    texts[section].emplace_back(key, text);
  }

  void add_number(const std::string& key, double& number, double least, double most,
                  const std::string& text) {
    std::ostringstream default_text;
    default_text << number;
    add(
        key, default_text.str(),
        [&number, least, most](const std::string& text) {
          number = to_number(text);
          if (number < least || number > most)
            throw std::invalid_argument(text);
        },
        text);
  }

  void add_count(const std::string& key, unsigned int& count, unsigned int least, unsigned int most,
                 const std::string& text) {
    add(
        key, std::to_string(count),
        [&count, least, most](const std::string& text) { count = to_count(text, least, most); },
        text);
  }

  template <typename Choice>
  void add_choice(const std::string& key, Choice& choice,
                  const std::map<std::string, Choice>& choices, const std::string& text) {
    std::string default_name;
    for (const auto& [name, value] : choices)
      if (value == choice)
        default_name = name;
    add(
        key, default_name,
        [&choice, choices](const std::string& name) { choice = choices.at(name); }, text);
  }

  void add_text(const std::string& key, std::string& value, const std::string& text) {
    add(
        key, value,
        [&value](const std::string& text) {
          if (text.empty())
            throw std::invalid_argument(text);
          value = text;
        },
        text);
  }

  /// Keys and their texts, by section.
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> texts;

private:
  ParameterHandler& prm;
  std::string section;
};

std::optional<std::pair<double, double>> parse_zone(const std::string& text) {
  if (text == "auto")
    return {};
  const auto ends = split(text, ',');
  if (ends.size() != 2)
    throw std::invalid_argument(text);
  return std::pair(to_number(ends[0]), to_number(ends[1]));
}

std::vector<std::vector<Setting>> parse_vary(const std::string& text) {
  std::vector<std::vector<Setting>> vary;
  for (const std::string& part : split(text, ';')) {
    const Setting all = parse_setting(part, "Study/Vary");
    vary.emplace_back();
    for (const std::string& value : split(all.value, '|'))
      vary.back().push_back({all.section, all.key, value, all.origin});
    if (all.section == "Study" || vary.back().empty())
      throw std::invalid_argument(text);
  }
  return vary;
}

std::vector<std::optional<unsigned int>> parse_counts(const std::string& text) {
  std::vector<std::optional<unsigned int>> counts;
  for (const std::string& part : split(text, ','))
    if (part == "-")
      counts.emplace_back();
    else
      counts.emplace_back(to_count(part, 1, 1000000000));
  return counts;
}

const std::map<std::string, OutputFile> output_files = {{"summary", OutputFile::summary},
                                                        {"contact", OutputFile::contact},
                                                        {"parameters", OutputFile::parameters},
                                                        {"solution", OutputFile::solution},
                                                        {"plot", OutputFile::plot},
                                                        {"mesh", OutputFile::mesh}};

std::vector<OutputFile> parse_files(const std::string& text) {
  std::vector<OutputFile> files;
  for (const std::string& name : split(text, ','))
    files.push_back(output_files.at(name));
  return files;
}

/// Every key of the program: name, default, range, unit and text, each in one statement.
void declare(Declarations& keys, Parameters& p) {
  const double tiny = std::numeric_limits<double>::min();
  const double huge = std::numeric_limits<double>::max();
  const unsigned int most = std::numeric_limits<int>::max();

  keys.enter("Cylinder");
  keys.add_number("Inner radius", p.cylinder.inner_radius, tiny, huge,
                  "Radius a of the rigid hub: a length, greater than 0.");
  keys.add_number("Outer radius", p.cylinder.outer_radius, tiny, huge,
                  "Radius b of the undeformed cylinder: a length, greater than a.");
  keys.add_number(
      "Angular velocity", p.cylinder.angular_velocity, 0, huge,
      "Angular velocity omega of rolling over the wave speed: one over a length, from 0 "
      "to 1/b.");
  keys.add_text("Radial force", p.cylinder.radial_force,
                "Radial force density f: an expression in r and z, a <= r <= b, 0 <= z < 2 pi.");
  keys.leave();

  keys.enter("Road");
  keys.add_number("Distance", p.road.distance, tiny, huge,
                  "Distance c of the flat road below the axle: a length, greater than a, less than "
                  "2 b.");
  keys.add(
      "Contact zone", "auto",
      [&p](const std::string& text) { p.road.contact_zone = parse_zone(text); },
      "The angles between which contact is possible: \"auto\" or two numbers \"z0, z1\" with "
      "pi < z0 < z1 < 2 pi, in radians; the lowest point is at 3 pi / 2. \"auto\" is the zone "
      "where "
      "phi < b.");
  keys.leave();

  keys.enter("Mesh");
  keys.add_count("Degree", p.mesh.degree, 1, 8,
                 "Polynomial degree of the elements, 1 to 8: 1 for Q1, 2 for Q2.");
  keys.add_count("Radial cells", p.mesh.radial_cells, 1, most,
                 "Cells from hub to surface, 1 or more.");
  keys.add_count("Angular cells", p.mesh.angular_cells, 3, most, "Cells around, 3 or more.");
  keys.add_count("Global refinements", p.mesh.global_refinements, 0, 20,
                 "How often every cell is cut into four, 0 to 20.");
  keys.add(
      "Adaptive cycles", "auto",
      [&p](const std::string& text) {
        p.mesh.adaptive_cycles =
            text == "auto" ? std::nullopt : std::optional(to_count(text, 0, 1000));
      },
      "How often the mesh is refined where the error is, after the global refinements: a number or "
      "\"auto\", as often as the wanted relative error needs, which is never when none is wanted.");
  keys.add_number("Wanted relative error", p.mesh.wanted_relative_error, 0, 1,
                  "Refine until the certified error in the energy norm, relative to the solution, "
                  "is no larger than this number, from 0 to 1; 0 for no such wish.");
  keys.add_choice<Indicator>(
      "Indicator", p.mesh.indicator,
      {{"auto", Indicator::automatic},
       {"residual", Indicator::residual},
       {"certificate", Indicator::certificate},
       {"kelly", Indicator::kelly}},
      "What tells where to refine. \"residual\": residuals and contact conditions on each cell, "
      "cheap. \"certificate\": the cells' parts of the error bound, for the smallest bound; costs "
      "a second linear solve in each cycle. \"kelly\": jumps of the normal derivative, for "
      "comparison. \"auto\": \"certificate\" with Certificate/Error bound, else \"residual\".");
  keys.add_choice<Marking>(
      "Marking", p.mesh.marking,
      {{"bulk", Marking::bulk}, {"number", Marking::number}, {"all", Marking::all}},
      "Which cells to refine. \"bulk\": the fewest that hold the marked fraction of the squared "
      "error. \"number\": the marked fraction of all cells. \"all\": every cell.");
  keys.add_number("Marked fraction", p.mesh.marked_fraction, 0.01, 1,
                  "The fraction that Marking speaks of, from 0.01 to 1.");
  keys.add_count("Most unknowns", p.mesh.most_unknowns, 1, most,
                 "A mesh with more unknowns than this number is refused; adaptive refinement ends "
                 "before it.");
  keys.leave();

  keys.enter("Certificate");
  keys.add_choice<bool>("Error bound", p.certificate.error_bound,
                        {{"false", false}, {"true", true}},
                        "\"true\" or \"false\": whether to compute a guaranteed bound of the error "
                        "in the energy norm, with bounds of the energy from both sides; costs "
                        "about a second linear solve.");
  keys.add_choice<bool>("Load bounds", p.certificate.load_bounds,
                        {{"false", false}, {"true", true}},
                        "\"true\" or \"false\": whether to bound the work-conjugate load G from "
                        "both sides, by the certified energies of two more road distances; costs "
                        "two more scenes on the last mesh.");
  keys.leave();

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
          throw std::invalid_argument(text);
      },
      "Uzawa's step length rho, pressure over displacement: \"auto\" or a number greater than 0. "
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
                 "The contact iteration gives up after this number of steps.");
  keys.leave();

  keys.enter("Solver");
  keys.add_choice<SolverKind>(
      "Kind", p.solver.kind, {{"auto", SolverKind::automatic}, {"direct", SolverKind::direct}},
      "How linear problems are solved. \"direct\": one sparse Cholesky factorisation for each "
      "mesh. \"auto\": the kind that suits the mesh, \"direct\" on one process.");
  keys.leave();

  keys.enter("Study");
  keys.add(
      "Vary", "", [&p](const std::string& text) { p.study.vary = parse_vary(text); },
      "Empty for a single scene, otherwise the keys to vary and their values, as in "
      "\"Mesh/Degree = 1 | 2; Contact/Rho = 1 | 2 | 3\": every combination is run, the last key "
      "varies fastest.");
  keys.add(
      "Published steps", "",
      [&p](const std::string& text) { p.study.published_steps = parse_counts(text); },
      "Numbers of contact steps to print beside ours: one for each run in the order of the runs, "
      "separated by commas, - where none is known.");
  keys.add_choice<bool>("True errors", p.study.true_errors, {{"false", false}, {"true", true}},
                        "\"true\" or \"false\": whether to compare every run with the exact "
                        "solution of its scene or, where none is known, with an adaptive solution "
                        "of quadratic elements that is much finer.");
  keys.add_count("Reference unknowns", p.study.reference_unknowns, 1, most,
                 "The most unknowns of that finer solution.");
  keys.leave();

  keys.enter("Output");
  keys.add_text("Directory", p.output.directory, "The directory of the files, made when missing.");
  keys.add(
      "Files", "summary, contact, parameters, solution, plot",
      [&p](const std::string& text) { p.output.files = parse_files(text); },
      "The files to write: any of summary (summary.json), contact (contact.csv), parameters "
      "(parameters.prm), solution (solution.vtu), plot (scene.svg; study.svg of a study), mesh "
      "(mesh.svg, the edges of the cells).");
  keys.leave();
}

/// Levenshtein's distance without regard to case: insertions, deletions and replacements.
unsigned int edit_distance(const std::string& from, const std::string& to) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<unsigned int> row(to.size() + 1);
  for (unsigned int j = 0; j < row.size(); ++j)
    row[j] = j;
  for (unsigned int i = 1; i <= from.size(); ++i) {
    unsigned int diagonal = row[0];
    row[0] = i;
    for (unsigned int j = 1; j < row.size(); ++j) {
      const unsigned int replaced = diagonal + (lower(from[i - 1]) == lower(to[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

/// "ORIGIN: section "S", key "K"", the beginning of every message about a setting.
std::string place(const Setting& setting) {
  return setting.origin + ": section \"" + setting.section + "\", key \"" + setting.key + "\"";
}

/// The message for a setting without a declared key: the nearest keys, then all of its section.
std::string unknown_key(const Setting& setting, const Declarations& keys) {
  std::multimap<unsigned int, std::string> nearest;
  for (const auto& [section, entries] : keys.texts)
    for (const auto& [key, text] : entries)
      nearest.emplace(edit_distance(setting.key, key) + edit_distance(setting.section, section),
                      section + "/" + key);
  std::string message = place(setting) + ": there is no such key; the nearest known: ";
  auto candidate = nearest.begin();
  for (unsigned int i = 0; i < 3; ++i, ++candidate)
    message += (i > 0 ? ", " : "") + candidate->second;
  const auto own = keys.texts.find(setting.section);
  if (own != keys.texts.end()) {
    message += "; all keys of this section: ";
    for (const auto& entry : own->second)
      message += (&entry != &own->second.front() ? ", " : "") + entry.first;
  }
  return message;
}

/// Hands @p settings to the declared keys, the later the stronger. @throws BadInput.
void apply(ParameterHandler& prm, const Declarations& keys, const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    const auto section = keys.texts.find(setting.section);
    if (section == keys.texts.end())
      throw BadInput(unknown_key(setting, keys));
    const auto entry =
        std::find_if(section->second.begin(), section->second.end(),
                     [&setting](const auto& candidate) { return candidate.first == setting.key; });
    if (entry == section->second.end())
      throw BadInput(unknown_key(setting, keys));
    prm.enter_subsection(setting.section);
    try {
      prm.set(setting.key, setting.value);
    } catch (const std::exception&) {
      throw BadInput(place(setting) + ", value \"" + setting.value +
                     "\" is not admitted. The key: " + entry->second);
    }
    prm.leave_subsection();
  }
}

} // namespace

bool Parameters::wants(OutputFile file) const {
  return std::find(output.files.begin(), output.files.end(), file) != output.files.end();
}

Parameters read_parameters(const std::vector<Setting>& settings) {
  Parameters parameters;
  ParameterHandler prm;
  Declarations keys(prm);
  declare(keys, parameters);
  apply(prm, keys, settings);
  parameters.settings = settings;
  return parameters;
}

std::string refusal(const std::vector<Setting>& settings, const std::string& section,
                    const std::string& key, const std::string& wanted) {
  const auto last = std::find_if(settings.rbegin(), settings.rend(), [&](const Setting& setting) {
    return setting.section == section && setting.key == key;
  });
  if (last == settings.rend())
    return place({section, key, "", "default value"}) + ": " + wanted;
  return place(*last) + ", value \"" + last->value + "\": " + wanted;
}

void print_parameters(std::ostream& out, const std::vector<Setting>& settings) {
  Parameters parameters;
  ParameterHandler prm;
  Declarations keys(prm);
  declare(keys, parameters);
  apply(prm, keys, settings);
  prm.print_parameters(out, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
}

} // namespace rollwave
