#ifndef ROLLWAVE_PARAMETERS_DECLARATIONS_H
#define ROLLWAVE_PARAMETERS_DECLARATIONS_H

#include "rollwave/parameters/prm_reader.h"

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// Where a setting was made and its section and key, the beginning of every message about it.
std::string place(const Setting& setting);

/// Declares keys to a ParameterHandler, which sets the variables behind them, and remembers their
/// texts for messages. The default of a key is the value of its variable.
class Declarations {
public:
  explicit Declarations(dealii::ParameterHandler& prm) : prm(prm) {}

  void enter(const std::string& name);
  void leave() { prm.leave_subsection(); }

  /// A key whose text is turned into a value by @p parse, which throws on a text not admitted.
  void add(const std::string& key, const std::string& default_text,
           const std::function<void(const std::string&)>& parse, const std::string& text);

  void add_number(const std::string& key, double& number, double least, double most,
                  const std::string& text);

  void add_count(const std::string& key, unsigned int& count, unsigned int least, unsigned int most,
                 const std::string& text);

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

  /// Any text but the empty one.
  void add_text(const std::string& key, std::string& value, const std::string& text);

  /// A key of earlier versions: setting it is refused with @p advice.
  void refuse(const std::string& section, const std::string& key, const std::string& advice);

  /// Hands @p settings to the declared keys, the later the stronger. @throws BadInput naming the
  /// setting that is not admitted and what is, or the nearest known keys.
  void apply(const std::vector<Setting>& settings) const;

private:
  std::string unknown_key(const Setting& setting) const;

  dealii::ParameterHandler& prm;
  std::string section;

  std::map<std::string, std::string> refused; ///< advice by path
  /// Keys and their texts, by section.
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> texts;
};

} // namespace rollwave

#endif
