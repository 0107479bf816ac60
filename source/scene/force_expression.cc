#include "rollwave/scene/force_expression.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace rollwave {

using namespace dealii;

namespace {

/// Keeps what is written to std::cerr while it lives: deal.II prints the parser's complaints there.
class CapturedErrors {
public:
  CapturedErrors() : original(std::cerr.rdbuf(captured.rdbuf())) {}
  ~CapturedErrors() { std::cerr.rdbuf(original); }
  CapturedErrors(const CapturedErrors&) = delete;
  CapturedErrors& operator=(const CapturedErrors&) = delete;

  /// The rest of the first line that has @p label; empty without one.
  std::string line_after(const std::string& label) const {
    const std::string all = captured.str();
    const auto found = all.find(label);
    if (found == std::string::npos)
      return {};
    const auto begin = found + label.size();
    return trimmed(all.substr(begin, all.find('\n', begin) - begin));
  }

private:
  std::ostringstream captured;
  std::streambuf* original;
};

/// The reason why the parser would misread @p expression: it takes 5 from "1,5" and 3 from "3;".
/// Empty if there is none.
std::string misunderstanding(const std::string& expression) {
  int depth = 0;
  for (std::size_t i = 0; i < expression.size(); ++i) {
    const char c = expression[i];
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0)
      return "A comma separates the arguments of a function; decimals have a point.";
    if (c == ';')
      return "It must be one expression; leave out the semicolon.";
    const bool is_comparison =
        expression.compare(i, 2, "==") == 0 ||
        (i > 0 && std::string("=<>!").find(expression[i - 1]) != std::string::npos);
    if (c == '=' && !is_comparison)
      return "r and z cannot be assigned to.";
  }
  return expression.find("rand") == std::string::npos
             ? ""
             : "A random number is no function of r and z.";
}

} // namespace

std::function<double(double r, double z)> parse_force(const std::string& expression,
                                                      double any_radius) {
  const auto refuse = [&](const std::string& why) {
    throw BadValue("Cylinder", "Radial force",
                   "it must be an expression in r and z, as in 1 + 0.5*r*cos(z). " +
                       printable(why));
  };
  if (const std::string why = misunderstanding(expression); !why.empty())
    refuse(why);
  auto parser = std::make_shared<FunctionParser<2>>(1);
  const auto force = [parser](double r, double z) { return parser->value(Point<2>(r, z)); };
  double value = 0;
  const CapturedErrors captured;
  try {
    parser->initialize("r,z", expression, {{"pi", numbers::PI}});
    value = force(any_radius, numbers::PI);
  } catch (const std::exception&) {
    refuse(captured.line_after("Message:"));
  }
  if (!std::isfinite(value))
    throw BadValue("Cylinder", "Radial force", "it must be finite everywhere between the radii");
  return force;
}

std::optional<double> constant_force(const std::string& expression) {
  try {
    return to_number(expression);
  } catch (const std::invalid_argument&) {
    if (std::regex_search(expression, std::regex("\\b[rz]\\b")))
      return {};
    return parse_force(expression, 1)(1, 1);
  }
}

} // namespace rollwave
