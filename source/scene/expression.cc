#include "rollwave/scene/expression.h"

#include "rollwave/base/text.h"

#include <deal.II/base/numbers.h>

#include <cmath>
#include <memory>
#include <muParser.h>
#include <stdexcept>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// muParser with the names that deal.II's FunctionParser knows.
mu::Parser make_parser() {
  mu::Parser parser;
  parser.DefineConst("pi", numbers::PI);
  parser.DefineFun(
      "if", +[](double condition, double value, double otherwise) {
        return condition != 0 ? value : otherwise;
      });
  parser.DefineFun(
      "pow", +[](double x, double y) { return std::pow(x, y); });
  using Function = double (*)(double);
  for (const auto& [name, function] : {std::pair<const char*, Function>("int", std::round),
                                       {"ceil", std::ceil},
                                       {"floor", std::floor},
                                       {"erf", std::erf},
                                       {"erfc", std::erfc}})
    parser.DefineFun(name, function);
  parser.DefineFun(
      "cot", +[](double x) { return 1 / std::tan(x); });
  parser.DefineFun(
      "sec", +[](double x) { return 1 / std::cos(x); });
  parser.DefineFun(
      "csc", +[](double x) { return 1 / std::sin(x); });
  return parser;
}

/// Refuses = other than in a comparison, since muParser would assign to a variable.
void refuse_assignment(const std::string& expression) {
  for (auto i = expression.find('='); i != std::string::npos; i = expression.find('=', i + 1)) {
    const bool is_first = expression.compare(i, 2, "==") == 0;
    const char before = i > 0 ? expression[i - 1] : ' ';
    if (!is_first && std::string("=<>!").find(before) == std::string::npos)
      throw std::invalid_argument("Nothing can be assigned to; a comparison is ==.");
  }
}

/// Gives the expression to the parser, and returns its first value. @throws std::invalid_argument
double first_value(mu::Parser& parser, const std::string& expression) {
  refuse_assignment(expression);
  double value = 0;
  int n_values = 0;
  try {
    parser.SetExpr(expression);
    value = *parser.Eval(n_values);
  } catch (const mu::Parser::exception_type& error) {
    throw std::invalid_argument(printable(error.GetMsg()));
  }
  if (n_values != 1)
    throw std::invalid_argument("A comma separates the arguments of a function; decimals have a "
                                "point.");
  if (!std::isfinite(value))
    throw std::invalid_argument("It is not finite.");
  return value;
}

} // namespace

double evaluate(const std::string& expression) {
  try {
    return to_number(expression);
  } catch (const std::invalid_argument&) {
    mu::Parser parser = make_parser();
    const double value = first_value(parser, expression);
    if (value != 0 && !std::isnormal(value))
      throw std::invalid_argument("It is too small.");
    return value;
  }
}

std::optional<double> value_if_any(const std::string& expression) {
  try {
    return evaluate(expression);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

std::function<double(double r, double z)> parse_function(const std::string& expression,
                                                         double any_radius) {
  struct Function {
    mu::Parser parser = make_parser();
    double r, z = numbers::PI;
  };
  const auto function = std::make_shared<Function>();
  function->r = any_radius;
  function->parser.DefineVar("r", &function->r);
  function->parser.DefineVar("z", &function->z);
  first_value(function->parser, expression);
  return [function](double r, double z) {
    function->r = r;
    function->z = z;
    return function->parser.Eval();
  };
}

} // namespace rollwave
