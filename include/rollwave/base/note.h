#pragma once

#include <string>
#include <vector>

namespace rollwave {

/// Something that the user should know about a result.
struct Note {
  enum class Kind {
    remark,
    shortfall ///< a target that was not reached; the text names the keys to change
  };
  Kind kind;
  std::string text;
};

/// The texts of the notes of a kind.
std::vector<std::string> texts_of(const std::vector<Note>& notes, Note::Kind kind);

/// The shortfalls with "; " between them.
std::string shortfall_text(const std::vector<Note>& notes);

} // namespace rollwave
