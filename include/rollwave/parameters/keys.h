#ifndef ROLLWAVE_PARAMETERS_KEYS_H
#define ROLLWAVE_PARAMETERS_KEYS_H

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

/// @p text as a value. @throws BadInput without a reason where it does not match @p pattern.
template <typename T>
T converted(const std::string& text, const dealii::Patterns::PatternBase& pattern) {
  if (!pattern.match(text))
    throw BadInput("");
  return dealii::Patterns::Tools::Convert<T>::to_value(text, pattern);
}

/**
 * The keys of parameter files, each bound to a variable whose value is the default. deal.II's
 * ParameterHandler reads, checks and prints them. Its exceptions become messages of one line with
 * origin, section, key, value and what is expected.
 */
class Keys {
public:
  /// Sets the variable of a key. Throws BadInput, with or without a reason, for other texts.
  using Parse = std::function<void(const std::string& value)>;

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
    const auto parse = [&variable, own](auto& value) { variable = converted<T>(value, *own); };
    declare(name, dealii::Patterns::Tools::Convert<T>::to_string(variable, pattern), pattern, text,
            attributes, parse);
  }

  /// A key with a value or, as its default, a word that stands for none.
  template <typename T>
  void add(const std::string& name, std::optional<T>& variable, const std::string& word,
           const dealii::Patterns::PatternBase& pattern, const std::string& text,
           const KeyAttributes& attributes = {}) {
    const auto own = std::shared_ptr(pattern.clone());
    const auto parse = [&variable, own, word](auto& value) {
      variable = value == word ? std::nullopt : std::optional(converted<T>(value, *own));
    };
    declare(name, word, dealii::Patterns::Anything(), text, attributes, parse);
  }

  /// A key whose value is one of several names.
  template <typename Choice>
  void add_choice(const std::string& name, Choice& variable,
                  const std::map<std::string, Choice>& choices, const std::string& text,
                  const KeyAttributes& attributes = {}) {
    std::string names, default_name;
    for (const auto& [known, choice] : choices) {
      names += (names.empty() ? "" : "|") + known;
      if (choice == variable)
        default_name = known;
    }
    declare(name, default_name, dealii::Patterns::Selection(names), text, attributes,
            [&variable, choices](auto& value) { variable = choices.at(value); });
  }

  /// A key whose value @p parse takes.
  void add_parsed(const std::string& name, const std::string& default_value, const Parse& parse,
                  const std::string& text, const KeyAttributes& attributes = {}) {
    declare(name, default_value, dealii::Patterns::Anything(), text, attributes, parse);
  }

  /// Gives the values in the text of a parameter file to their keys. @throws BadInput
  void read(const std::string& text, const std::string& file);

  /// Gives a value to its key. @throws BadInput
  void set(const Setting& setting);

  /// A complete commented parameter file.
  void print(std::ostream& out) const;

  /// In the order of their declaration.
  const std::vector<Key>& all() const { return keys; }

  /// The key of a setting. @throws BadInput with the nearest keys where there is none
  const Key& at(const Setting& setting) const;

  /// That of the value that is being read; empty for a default.
  const std::string& current_origin() const { return origin; }

private:
  void declare(const std::string& name, const std::string& default_value,
               const dealii::Patterns::PatternBase& pattern, const std::string& text,
               const KeyAttributes& attributes, const Parse& parse);
  std::string nearest(const std::string& section, const std::string& name) const;
  std::string explain(const dealii::ExceptionBase& error, const std::vector<Setting>& places,
                      const std::string& file) const;

  std::vector<Setting>& settings;
  std::string section, origin;
  unsigned int affected = 0; ///< by the keys of the section
  std::vector<Key> keys;
  dealii::ParameterHandler prm;
};

} // namespace rollwave

#endif
