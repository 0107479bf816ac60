#include "rollwave/run/contact_quantities.h"

namespace rollwave {

namespace {

using Value = std::function<std::optional<double>(const Result&)>;

/// Adds a quantity and the estimate of its error.
void add_estimated(Quantities& all, const ResultQuantity& quantity, const Value& uncertainty) {
  all.push_back(quantity);
  all.push_back({quantity.name + "_uncertainty", "estimated error of the " + quantity.words, "",
                 quantity.quantity, 0, 2, uncertainty});
}

/// Adds a load and the ends of its guaranteed interval, which are left out without certificate.
void add_certified(Quantities& all, const ResultQuantity& quantity, Interval LoadBounds::*load) {
  const auto end_of = [load](double Interval::*end) {
    return [load, end](const Result& result) {
      return result.certified ? std::optional(result.certified->loads.*load.*end) : std::nullopt;
    };
  };
  all.push_back(quantity);
  all.push_back({quantity.name + "_lower_bound", "guaranteed lower bound of the " + quantity.words,
                 "", quantity.quantity, 0, all_digits, end_of(&Interval::lower)});
  all.push_back({quantity.name + "_upper_bound", "guaranteed upper bound of the " + quantity.words,
                 "", quantity.quantity, 0, all_digits, end_of(&Interval::upper)});
}

void add_loads(Quantities& all) {
  add_certified(all,
                {"contact.vertical_load", "vertical load", "", Quantity::force,
                 Shown::screen | Shown::curve | Shown::scene_table, all_digits,
                 [](const Result& r) { return r.contact.loads.vertical; }},
                &LoadBounds::vertical);
  add_estimated(all,
                {"contact.length", "contact length (nip)", "", Quantity::length,
                 Shown::screen | Shown::curve | Shown::scene_table, 5,
                 [](const Result& r) { return r.contact.length(); }},
                [](const Result& r) { return r.contact.sum(&ContactPatch::length_uncertainty); });
  all.push_back({"contact.calibrated_shear_modulus", "calibrated shear modulus", "",
                 Quantity::pressure, Shown::scene_table, 5, [](const Result& r) {
                   return r.modulus_ratio ? std::optional(1.) : std::nullopt;
                 }});
  add_certified(all,
                {"contact.force", "contact force", "F", Quantity::force,
                 Shown::screen | Shown::table | Shown::curve, all_digits,
                 [](const Result& r) { return r.contact.loads.total; }},
                &LoadBounds::total);
  all.push_back({"contact.work_conjugate_load", "work-conjugate load", "G", Quantity::force,
                 Shown::screen, all_digits,
                 [](const Result& r) { return r.contact.loads.work_conjugate; }});
}

void add_stiffness(Quantities& all) {
  const auto add = [&all](const char* name, const char* words, unsigned int shown,
                          double (*number)(const Loads&)) {
    const auto stiffness = [number](const Result& r) {
      return r.contact.stiffness ? std::optional(number(*r.contact.stiffness)) : std::nullopt;
    };
    const auto uncertainty = [stiffness](const Result& r) {
      auto value = stiffness(r);
      if (value)
        *value *= r.contact.relative_stiffness_uncertainty;
      return value;
    };
    add_estimated(all, {name, words, "", Quantity::stiffness, shown, 4, stiffness}, uncertainty);
  };
  add("contact.stiffness.vertical_load", "vertical stiffness",
      Shown::screen | Shown::curve | Shown::scene_table,
      [](const Loads& stiffness) { return stiffness.vertical; });
  add("contact.stiffness.force", "stiffness -dF/dc", 0,
      [](const Loads& stiffness) { return stiffness.total; });
  add("contact.stiffness.work_conjugate_load", "stiffness -dG/dc", 0,
      [](const Loads& stiffness) { return *stiffness.work_conjugate; });
}

void add_pressure_and_ends(Quantities& all) {
  add_estimated(all,
                {"contact.peak_pressure", "peak pressure", "", Quantity::pressure,
                 Shown::screen | Shown::curve | Shown::scene_table, 5,
                 [](const Result& r) { return r.contact.peak_pressure; }},
                [](const Result& r) { return r.contact.peak_pressure_uncertainty; });
  const auto if_one_patch = [](double (ContactPatch::*number)() const) {
    return [number](const Result& r) {
      return r.contact.patches.size() < 2 ? std::optional(r.contact.sum(number)) : std::nullopt;
    };
  };
  add_estimated(all,
                {"contact.half_width", "half-width of contact", "", Quantity::angle, Shown::curve,
                 all_digits, if_one_patch(&ContactPatch::half_width)},
                if_one_patch(&ContactPatch::half_width_uncertainty));
  const auto if_contact = [](double ContactPatch::*number, bool is_left) {
    return [number, is_left](const Result& r) -> std::optional<double> {
      const auto& patches = r.contact.patches;
      if (patches.empty())
        return {};
      return (is_left ? patches.front() : patches.back()).*number;
    };
  };
  add_estimated(all,
                {"contact.left_end", "left end of the first patch", "", Quantity::angle, 0,
                 all_digits, if_contact(&ContactPatch::begin, true)},
                if_contact(&ContactPatch::begin_uncertainty, true));
  add_estimated(all,
                {"contact.right_end", "right end of the last patch", "", Quantity::angle, 0,
                 all_digits, if_contact(&ContactPatch::end, false)},
                if_contact(&ContactPatch::end_uncertainty, false));
  all.push_back({"contact.patch_count", "patches", "", Quantity::count, 0, all_digits,
                 [](const Result& r) { return r.contact.patches.size(); }});
  all.push_back({"contact.active_nodes", "nodes in contact", "", Quantity::count, 0, all_digits,
                 [](const Result& r) { return r.contact.active_nodes; }});
}

} // namespace

Quantities contact_quantities() {
  Quantities all;
  add_loads(all);
  add_stiffness(all);
  add_pressure_and_ends(all);
  return all;
}

} // namespace rollwave
