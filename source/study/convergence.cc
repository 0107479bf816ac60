#include "rollwave/study/convergence.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/text.h"
#include "rollwave/run/quantities.h"

#include <deal.II/base/convergence_table.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <utility>

namespace rollwave {

namespace {

struct Fit {
  double slope, spread;
};

/// The slope of @p y over @p x by least squares, and its standard error.
Fit fit(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = x.size();
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0, rest = 0;
  for (unsigned int i = 0; i < n; ++i) {
    x_mean += x[i] / n;
    y_mean += y[i] / n;
  }
  for (unsigned int i = 0; i < n; ++i) {
    xx += std::pow(x[i] - x_mean, 2);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
  }
  for (unsigned int i = 0; i < n; ++i)
    rest += std::pow(y[i] - y_mean - xy / xx * (x[i] - x_mean), 2);
  return {xy / xx, std::sqrt(rest / (n - 2) / xx)};
}

/// The abscissa of the orders: h of uniform meshes, the largest diameter of a cell; N^(-1/2) of
/// adaptive ones, N the number of unknowns. nullopt for a run that is not solved.
std::optional<double> abscissa(const Study& study, const Family& family, unsigned int run) {
  const auto n_unknowns = study.value(run, "mesh.dofs");
  return family.is_adaptive && n_unknowns ? 1 / std::sqrt(*n_unknowns)
                                          : study.value(run, "mesh.h_max");
}

constexpr double least_ratio = 1.2; ///< of the abscissae of two meshes

/// The runs of a family that are solved, each with another abscissa than the one before by the
/// least ratio: others would give orders by chance.
std::vector<unsigned int> meshes_of(const Study& study, const Family& family) {
  std::vector<unsigned int> meshes;
  for (const unsigned int run : family.runs)
    if (const auto x = abscissa(study, family, run)) {
      const double before = meshes.empty() ? 0 : *abscissa(study, family, meshes.back());
      if (*x >= least_ratio * before || before >= least_ratio * *x)
        meshes.push_back(run);
    }
  return meshes;
}

/// Those of the meshes on which an error is known: the finest may be below the accuracy of the
/// exact answer.
std::vector<unsigned int> meshes_with(const Study& study, std::vector<unsigned int> meshes,
                                      const ResultQuantity& error) {
  meshes.erase(std::remove_if(
                   meshes.begin(), meshes.end(),
                   [&](unsigned int run) { return study.value(run, error.name).value_or(0) <= 0; }),
               meshes.end());
  return meshes;
}

/// The errors whose orders are reported: those that are known on two meshes or more.
std::vector<ResultQuantity> known_errors(const Study& study,
                                         const std::vector<unsigned int>& meshes) {
  std::vector<ResultQuantity> errors;
  for (const ResultQuantity& quantity : result_quantities())
    if ((quantity.shown & Shown::orders) && meshes_with(study, meshes, quantity).size() > 1)
      errors.push_back(quantity);
  return errors;
}

/// True if from each mesh to the next the cells get smaller, or larger, in both directions.
bool changes_both_directions(const Study& study, const std::vector<unsigned int>& meshes) {
  const auto n_cells = [&](unsigned int run) {
    const auto& mesh = study.plans[run].parameters.mesh;
    return std::pair(std::ldexp(mesh.radial_cells, mesh.global_refinements),
                     std::ldexp(mesh.angular_cells, mesh.global_refinements));
  };
  return std::adjacent_find(meshes.begin(), meshes.end(), [&](unsigned int one, unsigned int next) {
           const auto [radial, angular] = n_cells(one);
           const auto [next_radial, next_angular] = n_cells(next);
           return (next_radial - radial) * (next_angular - angular) <= 0;
         }) == meshes.end();
}

/// The errors on all meshes with their orders from one to the next; "nan" where they are not known.
void print_errors(std::ostream& out, const Study& study, const Family& family,
                  const std::vector<unsigned int>& meshes,
                  const std::vector<ResultQuantity>& errors) {
  dealii::ConvergenceTable table;
  const std::string inverse = family.is_adaptive ? "unknowns^(1/2)" : "1/h";
  for (const unsigned int run : meshes) {
    table.add_value("unknowns", static_cast<unsigned int>(*study.value(run, "mesh.dofs")));
    table.add_value(inverse, 1 / *abscissa(study, family, run));
  }
  table.set_precision(inverse, 4);
  for (const ResultQuantity& error : errors) {
    const std::string title = error.symbol + study.units().in_brackets(error.quantity);
    for (const unsigned int run : meshes) {
      const auto value = study.value(run, error.name);
      const bool is_bound = error.shown & Shown::upper_bound;
      table.add_value(title, !value      ? std::numeric_limits<double>::quiet_NaN()
                             : !is_bound ? *value
                                         : std::stod(rounded_up(*value, 4)));
    }
    table.set_precision(title, 3); // after the first digit
    table.set_scientific(title, true);
    table.evaluate_convergence_rates(title, inverse, dealii::ConvergenceTable::reduction_rate_log2,
                                     1);
  }
  out << table_text(table);
}

/// The orders over the last four meshes with each error.
void print_fits(std::ostream& out, const Study& study, const Family& family,
                const std::vector<unsigned int>& meshes,
                const std::vector<ResultQuantity>& errors) {
  const bool is_cut_in_four = most_cycles(study.plans[meshes.back()].parameters.mesh) > 0;
  const auto expected = is_cut_in_four || changes_both_directions(study, meshes)
                            ? study.value(meshes.back(), "error.expected_order")
                            : std::nullopt;
  std::string separator = "Fitted, +- standard error: ";
  for (const ResultQuantity& error : errors) {
    auto last = meshes_with(study, meshes, error);
    constexpr std::size_t most_meshes = 4;
    last.erase(last.begin(), last.end() - std::min(most_meshes, last.size()));
    if (last.size() < 3)
      continue;
    std::vector<double> x, y;
    for (const unsigned int run : last) {
      x.push_back(-std::log(*abscissa(study, family, run)));
      y.push_back(-std::log(*study.value(run, error.name)));
    }
    const Fit order = fit(x, y);
    out << separator << error.symbol << ' ' << std::setprecision(3) << order.slope << " +- "
        << std::setprecision(1) << std::round(1000 * order.spread) / 1000 << std::setprecision(6);
    if (error.name == "error.exact_relative" && expected)
      out << " (expected " << *expected << ')';
    separator = ", ";
  }
  out << '\n';
}

} // namespace

std::vector<Family> find_families(const Study& study) {
  std::vector<Family> families;
  std::map<std::string, unsigned int> number_of;
  for (unsigned int i = 0; i < study.plans.size(); ++i) {
    const RunPlan& plan = study.plans[i];
    std::vector<Setting> others; // than those that make a mesh finer
    for (const Setting& setting : plan.varied)
      if ((key_of(setting).affects & Affects::resolution) == 0)
        others.push_back(setting);
    const std::string name = label(plan, others);
    const auto [entry, is_first] = number_of.emplace(name, families.size());
    if (is_first)
      families.push_back({name, {}, false});
    Family& family = families[entry->second];
    family.runs.push_back(i);
    family.is_adaptive = family.is_adaptive || is_adaptive(plan.parameters.mesh);
  }
  return families;
}

Panel error_panel(const Study& study, const std::string& x, const std::string& x_label,
                  double order_factor) {
  const std::string exact = "error.exact_relative", bound = "error.certified_relative";
  const ResultQuantity& error = result_quantity(study.has(exact) ? exact : bound);
  Panel panel{x_label, error.words, {}, true, true};
  std::set<double> orders;
  for (const Family& family : find_families(study)) {
    if (x == "mesh.h_max" && family.is_adaptive)
      continue;
    const bool is_exact =
        std::any_of(family.runs.begin(), family.runs.end(),
                    [&](unsigned int run) { return study.value(run, exact).has_value(); });
    Curve curve{family.name + (study.has(exact) && !is_exact ? ", bound" : ""), {}};
    for (const unsigned int run : family.runs) {
      const auto value = study.value(run, is_exact ? exact : bound);
      if (study.value(run, x) && value)
        curve.points.push_back({*study.value(run, x), *value});
      if (const auto order = study.value(run, "error.expected_order"); order && order_factor != 0)
        orders.insert(*order);
    }
    if (!curve.points.empty())
      panel.curves.push_back(std::move(curve));
  }
  for (const double order : orders)
    panel.slopes.push_back(order_factor * order);
  return panel;
}

void report_orders(std::ostream& out, const Study& study) {
  bool has_orders = false;
  for (const Family& family : find_families(study)) {
    const auto meshes = meshes_of(study, family);
    const auto errors = known_errors(study, meshes);
    if (meshes.size() < 2 || errors.empty())
      continue;
    has_orders = true;
    const std::string x = family.is_adaptive ? "unknowns^(-1/2)" : "h";
    out << "\nOrders in " << x << (family.is_adaptive ? ", adaptive meshes" : "")
        << (family.name.empty() ? "" : ", ") << family.name;
    if (meshes.size() < family.runs.size())
      out << ", only meshes whose " << x << " differs by a factor of " << least_ratio << " or more";
    out << '\n';
    print_errors(out, study, family, meshes, errors);
    if (meshes.size() > 2)
      print_fits(out, study, family, meshes, errors);
  }
  if (has_orders && study.has("error.exact_relative"))
    out << (study.has("error.certified_relative") ? "certified and error are" : "error is")
        << " relative. The other errors are absolute, that of the pressure in the\n"
           "discrete L2 norm. Single orders scatter with the position of the ends of contact in\n"
           "their cells.\n";
}

} // namespace rollwave
