#include "rollwave/run/note.h"

namespace rollwave {

std::vector<std::string> texts_of(const std::vector<Note>& notes, Note::Kind kind) {
  std::vector<std::string> texts;
  for (const Note& note : notes)
    if (note.kind == kind)
      texts.push_back(note.text);
  return texts;
}

} // namespace rollwave
