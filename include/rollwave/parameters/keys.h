#pragma once

#include "rollwave/parameters/key.h"
#include "rollwave/parameters/parameters.h"

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace rollwave {

/// @throws BadInput with the nearest sections where there is none of this name
void check_section(const std::string& name, const std::string& place);

/// The numbers that a key allows.
struct Range {
  double least, most;
};

/// The shortest text that is read back as @p number; whole numbers have no exponent up to 1e15.
std::string number_text(double number);

/// The number or arithmetic expression in @p text, which becomes the number.
/// @throws std::invalid_argument for others, also outside of @p range or if it must be whole
double convert_number(std::string& text, const Range& range, bool is_whole = false);

/// A section of parameter files, whose keys are bound to the members of its owner's options. The
/// default of a key is that of its member.
template <typename Options>
class Section {
public:
  /// @param keys to which those of the section are added
  /// @param affects flags of Affects that all of them have
  Section(std::vector<Key>& keys, const std::string& name, Options Parameters::*options,
          unsigned int affects = 0)
      : keys(keys), name(name), options(options), affects(affects) {}

  /// A number; it must be whole if its type is.
  template <typename T, typename Owner>
  void add(const std::string& key, T Owner::*member, const Range& range, const std::string& text,
           const KeyAttributes& attributes = {}) {
    const auto read = [options = options, member, range](Setting& setting) {
      const T value = convert_number(setting.value, range, std::is_integral_v<T>);
      return [=](Parameters& p) { (p.*options).*member = value; };
    };
    declare(key, number_text(Options().*member), read, text, attributes);
  }

  /// A number or, as its default, a word that stands for none.
  template <typename T, typename Owner>
  void add(const std::string& key, std::optional<T> Owner::*member, const std::string& word,
           const Range& range, const std::string& text, const KeyAttributes& attributes = {}) {
    const auto read = [options = options, member, word, range](Setting& setting) {
      std::optional<T> value;
      if (setting.value != word)
        value = convert_number(setting.value, range, std::is_integral_v<T>);
      return [=](Parameters& p) { (p.*options).*member = value; };
    };
    declare(key, word, read, text, attributes);
  }

  /// "true" or "false".
  template <typename Owner>
  void add(const std::string& key, bool Owner::*member, const std::string& text,
           const KeyAttributes& attributes = {}) {
    add_choice(key, member, {{"true", true}, {"false", false}}, text, attributes);
  }

  /// One of several names.
  template <typename Choice, typename Owner>
  void add_choice(const std::string& key, Choice Owner::*member,
                  const std::map<std::string, Choice>& choices, const std::string& text,
                  const KeyAttributes& attributes = {}) {
    std::string default_name;
    for (const auto& [known, choice] : choices)
      if (choice == Options().*member)
        default_name = known;
    const auto read = [options = options, member, choices](Setting& setting) {
      const auto found = choices.find(setting.value);
      if (found == choices.end())
        throw std::invalid_argument("");
      const Choice choice = found->second;
      return [=](Parameters& p) { (p.*options).*member = choice; };
    };
    declare(key, default_name, read, text, attributes);
  }

  /// A key whose value @p read takes.
  void declare(const std::string& key, const std::string& default_value, const Key::Read& read,
               const std::string& text, const KeyAttributes& attributes = {}) {
    keys.push_back({attributes, name, key, default_value, text, read});
    keys.back().affects |= affects;
  }

private:
  std::vector<Key>& keys;
  const std::string name;
  Options Parameters::*options;
  const unsigned int affects;
};

} // namespace rollwave
