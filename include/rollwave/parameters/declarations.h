#ifndef ROLLWAVE_PARAMETERS_DECLARATIONS_H
#define ROLLWAVE_PARAMETERS_DECLARATIONS_H

#include "rollwave/parameters/prm_reader.h"

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <iosfwd>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace rollwave {

/// Where a setting was made and its section and key, the beginning of every message about it.
std::string place(const Setting& setting);

/// The value that @p choices have for a name. @throws std::invalid_argument
template <typename Choice>
Choice choice_of(const std::string& name, const std::map<std::string, Choice>& choices) {
  for (const auto& [known, value] : choices)
    if (name == known)
      return value;
    else if (is_equal_but_for_case(name, known))
      throw std::invalid_argument("it is written " + in_quotes(known));
  throw std::invalid_argument("");
}

/// The keys of parameter files with the variables behind them and their texts for messages. The
/// default of a key is the value of its variable.
class Declarations {
public:
  /// The section of the keys that follow.
  void enter(const std::string& name) { section = name; }

  /// A key whose text @p parse turns into a value. It throws std::invalid_argument, with a reason
  /// if it knows one, for a text that is not admitted.
  void add(const std::string& key, const std::string& default_text,
           const std::function<void(const std::string&)>& parse, const std::string& text);

  void add_number(const std::string& key, double& number, double least, double most,
                  const std::string& text);

  void add_count(const std::string& key, unsigned int& count, unsigned int least, unsigned int most,
                 const std::string& text);

  /// "true" or "false"
  void add_flag(const std::string& key, bool& flag, const std::string& text);

  template <typename Choice>
  void add_choice(const std::string& key, Choice& choice,
                  const std::map<std::string, Choice>& choices, const std::string& text) {
    std::string default_name;
    for (const auto& [name, value] : choices)
      if (value == choice)
        default_name = name;
    add(
        key, default_name,
        [&choice, choices](const std::string& name) { choice = choice_of(name, choices); }, text);
  }

  /// Any text but the empty one.
  void add_text(const std::string& key, std::string& value, const std::string& text);

  /// Hands @p settings to their keys, the later the stronger. @throws BadInput naming the setting
  /// that is not admitted and what is, or the nearest known keys.
  void apply(const std::vector<Setting>& settings);

  /// @throws BadInput where the key of a setting is none.
  void check_key(const Setting& setting) const { find(setting); }

  /// A complete commented parameter file.
  void print(std::ostream& out) const;

private:
  struct Key {
    std::string section, name, text;
    std::function<void(const std::string&)> parse;
  };

  const Key& find(const Setting& setting) const;

  std::string section;
  std::vector<Key> keys;
  dealii::ParameterHandler prm; ///< prints
};

} // namespace rollwave

#endif
