#pragma once

#include "rollwave/parameters/key.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// @p text as a value. @throws BadInput without a reason if it does not match @p pattern.
template <typename T>
T converted(const std::string& text, const dealii::Patterns::PatternBase& pattern) {
  if (!pattern.match(text))
    throw BadInput("");
  return dealii::Patterns::Tools::Convert<T>::to_value(text, pattern);
}

/**
 * The keys of parameter files, each bound to a variable whose value is the default. deal.II's
 * ParameterHandler reads and prints them, its patterns check them. A refusal is a message of one
 * line with origin, section, key, value and what is expected.
 */
class Keys {
public:
  /// Sets the variable of a key. Throws BadInput for other texts; without a reason the message
  /// shows the text of the key.
  using Parse = std::function<void(const Setting& setting)>;

  /// @param settings to which every value given to a key is appended
  explicit Keys(std::vector<Setting>& settings) : settings(settings) {}
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  /// Begins a section. @param affects flags of Affects that all its keys have
  void enter(const std::string& name, unsigned int affects);

  /// A key whose value deal.II converts.
  template <typename T>
  void add(const std::string& name, T& variable, const dealii::Patterns::PatternBase& pattern,
           const std::string& text, const KeyAttributes& attributes = {}) {
    const auto own = std::shared_ptr(pattern.clone());
    declare(
        name, dealii::Patterns::Tools::Convert<T>::to_string(variable, pattern),
        [&variable, own](const Setting& setting) { variable = converted<T>(setting.value, *own); },
        text, attributes);
  }

  /// A key with a value or, as its default, a word that stands for none.
  template <typename T>
  void add(const std::string& name, std::optional<T>& variable, const std::string& word,
           const dealii::Patterns::PatternBase& pattern, const std::string& text,
           const KeyAttributes& attributes = {}) {
    const auto own = std::shared_ptr(pattern.clone());
    const auto parse = [&variable, own, word](const Setting& setting) {
      variable =
          setting.value == word ? std::nullopt : std::optional(converted<T>(setting.value, *own));
    };
    declare(name, word, parse, text, attributes);
  }

  /// A key whose value is one of several names.
  template <typename Choice>
  void add_choice(const std::string& name, Choice& variable,
                  const std::map<std::string, Choice>& choices, const std::string& text,
                  const KeyAttributes& attributes = {}) {
    std::string default_name;
    for (const auto& [known, choice] : choices)
      if (choice == variable)
        default_name = known;
    const auto parse = [&variable, choices](const Setting& setting) {
      if (choices.count(setting.value) == 0)
        throw BadInput("");
      variable = choices.at(setting.value);
    };
    declare(name, default_name, parse, text, attributes);
  }

  /// A key whose value @p parse takes.
  void declare(const std::string& name, const std::string& default_value, const Parse& parse,
               const std::string& text, const KeyAttributes& attributes = {});

  /// Gives the values in the text of a parameter file to their keys. @throws BadInput
  void read(const std::string& text, const std::string& file);

  /// Gives a value to its key. @throws BadInput
  void set(const Setting& setting);

  /// A complete commented parameter file.
  void print(std::ostream& out) const;

  /// In the order of their declaration.
  const std::vector<Key>& all() const { return keys; }

private:
  const Key& at(const Setting& setting) const;
  std::string nearest(const std::string& section, const std::string& name) const;

  std::vector<Setting>& settings;
  std::string section;
  unsigned int affected = 0;           ///< by the keys of the section
  std::function<std::string()> origin; ///< of the value that is being read; empty for defaults
  std::vector<Key> keys;
  dealii::ParameterHandler prm;
};

} // namespace rollwave
