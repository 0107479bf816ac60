#ifndef ROLLWAVE_PARAMETERS_H
#define ROLLWAVE_PARAMETERS_H

#include "settings.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// Of the elements, `Mesh/Degree`.
constexpr unsigned int highest_degree = 8;

enum class ContactMethod {
  /// "active set": primal-dual active set (semismooth Newton); needs no step length.
  active_set,
  /// "uzawa": projected gradient steps on the pressure, the method of Ross and Bercovier.
  uzawa
};

enum class UzawaStop {
  /// "gap": ||p_new - p|| / rho, the violation of the contact conditions as a displacement.
  gap,
  /// "change": ||u_new - u||, the rule behind the paper's figure 9.
  change
};

enum class SolverKind {
  /// "auto": the kind that suits the mesh.
  automatic,
  /// "direct": one sparse Cholesky factorisation for each mesh.
  direct,
  /// "iterative": conjugate gradients with algebraic multigrid.
  iterative
};

enum class Indicator {
  /// "residual": the residual indicator.
  residual,
  /// "kelly": jumps of the normal derivative, deal.II's KellyErrorEstimator; for comparison.
  kelly
};

enum class Marking {
  /// "bulk": the cells with the largest indicators that hold a fraction of the sum of squares.
  bulk,
  /// "number": a fraction of all cells, those with the largest indicators.
  number,
  /// "all": every cell.
  all
};

enum class OutputFile { summary, contact, parameters, solution, plot };

/**
 * All that a parameter file can say, one member for each key, in the file's sections. Lengths share
 * one unit, chosen by the user; angles are in radians; the wave speed and the shear modulus are 1.
 */
struct Parameters {
  struct {
    double inner_radius = 0.5;
    double outer_radius = 1;
    double angular_velocity = 0.5;
    std::string radial_force = "0";
  } cylinder;

  struct {
    double distance = 0.8;
    std::optional<std::pair<double, double>> contact_zone; ///< nullopt: automatic
  } road;

  struct {
    unsigned int degree = 2;
    unsigned int radial_cells = 16;
    unsigned int angular_cells = 200;
    unsigned int global_refinements = 0;
    std::optional<unsigned int> adaptive_cycles; ///< nullopt: as many as the wanted error needs
    double wanted_relative_error = 0;            ///< 0: none
    Indicator indicator = Indicator::residual;
    Marking marking = Marking::bulk;
    double marked_fraction = 0.6;
    unsigned int most_unknowns = 5000000;
  } mesh;

  struct {
    bool error_bound = true;
    bool load_bounds = false;
  } certificate;

  struct {
    ContactMethod method = ContactMethod::active_set;
    std::optional<double> rho; ///< nullopt: from an estimate of the largest compliance
    UzawaStop stop = UzawaStop::gap;
    double tolerance = 1e-8;
    unsigned int most_steps = 20000;
  } contact;

  struct {
    SolverKind kind = SolverKind::automatic;
  } solver;

  /// A scene of a study by its name, with the settings that make it.
  struct NamedScene {
    std::string name;
    std::vector<Setting> settings;
  };

  struct {
    std::vector<NamedScene> scenes; ///< none: the scene of the file

    /// One list of settings for each varied key; the study runs every combination.
    std::vector<std::vector<Setting>> vary;
    std::vector<std::optional<unsigned int>> published_steps;
    bool true_errors = false;
    unsigned int processes_per_scene = 0; ///< 0: all of them
  } study;

  struct {
    std::string directory = "output";
    std::vector<OutputFile> files;
  } output;

  /// What was set, in order of increasing precedence; later entries override earlier ones.
  std::vector<Setting> settings;

  bool wants(OutputFile file) const;
};

/**
 * The parameters that @p settings describe; keys not mentioned keep their defaults.
 *
 * @throws BadInput for an unknown section or key (naming the nearest known ones), or a value that
 *         its key does not admit. What depends on several keys is checked by make_scene().
 */
Parameters read_parameters(const std::vector<Setting>& settings);

/// How often a run refines its mesh at most.
unsigned int most_cycles(const Parameters& parameters);

/// The message for a value that is not admitted: where it was set, section, key, value and what is
/// wanted instead.
std::string refusal(const std::vector<Setting>& settings, const std::string& section,
                    const std::string& key, const std::string& wanted);

/// A complete commented parameter file: defaults, overridden by @p settings.
/// @throws BadInput as read_parameters().
void print_parameters(std::ostream& out, const std::vector<Setting>& settings);

} // namespace rollwave

#endif
