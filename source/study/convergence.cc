#include "rollwave/study/convergence.h"

#include "rollwave/adapt/marking.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

namespace rollwave {

namespace {

/// log(1/h) in a family of this kind, up to a constant, from a mesh on; nullopt unless the cells
/// are cut alike.
std::optional<double> refinement(const Study& study, const Family& family, unsigned int first,
                                 unsigned int run) {
  if (family.is_adaptive) {
    const auto from = study.figure(first, "dofs"), to = study.figure(run, "dofs");
    return from && to ? std::optional(std::log(*to / *from) / 2) : std::nullopt;
  }
  const auto &from = study.plans[first].parameters.mesh, &to = study.plans[run].parameters.mesh;
  if (1. * from.radial_cells * to.angular_cells != 1. * to.radial_cells * from.angular_cells)
    return {};
  return std::log(std::ldexp(to.radial_cells, to.global_refinements) /
                  std::ldexp(from.radial_cells, from.global_refinements));
}

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

/// The order of a figure over the last runs of a family that have it; nullopt for less than three
/// meshes, or cells that are not cut alike.
std::optional<Fit> fit_order(const Study& study, const Family& family, const std::string& name) {
  constexpr unsigned int most_meshes = 4;
  std::vector<double> x, y;
  unsigned int last = 0;
  for (auto run = family.runs.rbegin(); run != family.runs.rend() && x.size() < most_meshes; ++run)
    if (const auto value = study.figure(*run, name); value && *value > 0) {
      last = x.empty() ? *run : last;
      const auto place = refinement(study, family, last, *run);
      if (!place)
        return {};
      if (std::find(x.begin(), x.end(), *place) == x.end()) {
        x.push_back(*place);
        y.push_back(-std::log(*value));
      }
    }
  return x.size() < 3 ? std::nullopt : std::optional(fit(x, y));
}

} // namespace

std::vector<Family> find_families(const Study& study) {
  std::vector<Family> families;
  std::map<std::map<std::string, std::string>, unsigned int> number_of;
  for (unsigned int i = 0; i < study.plans.size(); ++i) {
    const RunPlan& plan = study.plans[i];
    auto common = plan.identity;
    for (const Key& key : all_keys())
      if (key.affects & Affects::resolution)
        common.erase(key.path());
    common["scene"] = plan.scene;
    const auto [entry, is_new] = number_of.emplace(common, families.size());
    if (is_new) {
      const auto is_common = [](const Setting& setting) {
        return (key_of(setting).affects & Affects::resolution) == 0;
      };
      families.push_back({label(plan, is_common), {}, false, true});
    }
    Family& family = families[entry->second];
    family.runs.push_back(i);
    family.is_adaptive = family.is_adaptive || most_cycles(plan.parameters.mesh) > 0;
    family.is_cut_alike = family.is_adaptive || (family.is_cut_alike &&
                                                 refinement(study, family, family.runs.front(), i));
  }
  return families;
}

std::optional<double> observed_order(const Study& study, const std::vector<Family>& families,
                                     unsigned int run) {
  const auto family = std::find_if(families.begin(), families.end(), [run](const Family& family) {
    return std::binary_search(family.runs.begin(), family.runs.end(), run);
  });
  const auto own = std::lower_bound(family->runs.begin(), family->runs.end(), run);
  if (own == family->runs.begin())
    return {};
  const unsigned int before = *(own - 1);
  const auto place = refinement(study, *family, before, run);
  for (const char* const name : {"error_relative", "certified_relative"}) {
    const auto from = study.figure(before, name), to = study.figure(run, name);
    if (from && to && *from > 0 && *to > 0 && place && *place != 0)
      return std::log(*from / *to) / *place;
  }
  return {};
}

void report_orders(std::ostream& out, const Study& study) {
  const std::vector<std::pair<std::string, std::string>> errors = {
      {"error_relative", "energy norm"},
      {"certified_relative", "certified"},
      {"error_l2_norm", "L2 norm"},
      {"error_pressure", "pressure"},
      {"error_force", "F"}};
  for (const Family& family : find_families(study)) {
    bool is_first = true;
    for (const auto& [name, text] : errors)
      if (const auto order = fit_order(study, family, name)) {
        if (is_first)
          out << "Orders in " << (family.is_adaptive ? "N^(-1/2)" : "h")
              << (family.name.empty() ? "" : ", ") << family.name << ": ";
        out << std::setprecision(3) << (is_first ? "" : ", ") << text << ' ' << order->slope
            << " +- " << std::setprecision(1) << std::round(1000 * order->spread) / 1000
            << std::setprecision(6);
        const auto expected = study.figure(family.runs.back(), "expected_order");
        if (name == "error_relative" && expected)
          out << " (expected " << *expected << ')';
        is_first = false;
      }
    out << (is_first ? "" : "\n");
  }
}

} // namespace rollwave
