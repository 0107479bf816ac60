#ifndef ROLLWAVE_FORCE_COLUMNS_H
#define ROLLWAVE_FORCE_COLUMNS_H

#include <map>
#include <vector>

namespace rollwave {

struct Scene;

/**
 * The integral G(r, z) = int_r^b rho f_0(rho, z) drho of a force f_0 that interpolates the scene's
 * force f: for every z, rho f_0 is on each of a number of radial panels (of equal ratio of their
 * ends) the polynomial of degree 15 that equals rho f at Gauss' points. A uniform force is its own
 * interpolant, with G = f (b^2 - r^2)/2.
 */
class ForceColumns {
public:
  ForceColumns(const Scene& scene, unsigned int n_panels);

  /// One angle z.
  class Column {
  public:
    double integral(double r) const; ///< G(r, z)
    double force(double r) const;    ///< f_0(r, z)

  private:
    friend class ForceColumns;
    const Scene* scene;
    const std::vector<double>* ends;
    std::vector<std::vector<double>> coefficients; ///< of rho f_0, by Legendre polynomials
    std::vector<double> outside;                   ///< G at the outer end of each panel
  };

  /// Made when first asked for.
  const Column& at(double z);

  /// Whether f_0 is f itself.
  bool are_exact() const;

private:
  Column make(double z) const;

  const Scene& scene;
  std::vector<double> ends;
  std::map<double, Column> known;
};

} // namespace rollwave

#endif
