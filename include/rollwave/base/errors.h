#pragma once

#include <stdexcept>
#include <string>

namespace rollwave {

/// The user's input is wrong; the program ends with exit code 1.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The value of a key is not allowed. refusal() adds the place where it was set.
struct BadValue : BadInput {
  BadValue(const std::string& section, const std::string& key, const std::string& reason)
      : BadInput(section + "/" + key + ": " + reason), section(section), key(key), reason(reason) {}

  std::string section, key;
  std::string reason; ///< what is allowed, or why the value is not
};

/// The scene could not be solved to what was wanted; exit code 2. The text says what was reached,
/// what was wanted and which parameter to change.
struct NotSolved : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// There is a result, but a target was not reached; exit code 2.
struct TargetNotReached : NotSolved {
  using NotSolved::NotSolved;
};

/// Thrown where a method needs more memory than there is.
struct NotEnoughMemory : NotSolved {
  /// @p reason says what needs how much; the advice is added.
  explicit NotEnoughMemory(const std::string& reason = "not enough memory")
      : NotSolved(reason + "; lower Mesh/Radial cells, Mesh/Angular cells or Mesh/Global "
                           "refinements, or narrow Road/Contact zone"),
        reason(reason) {}

  std::string reason;
};

/// The user has interrupted the program before there was a result; exit code 2.
struct Interrupted : NotSolved {
  using NotSolved::NotSolved;
};

/// A result could not be written; exit code 3. No file is left half-written.
struct NotWritten : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace rollwave
