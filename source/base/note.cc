#include "rollwave/base/note.h"

#include <boost/algorithm/string/join.hpp>

namespace rollwave {

std::vector<std::string> texts_of(const std::vector<Note>& notes, Note::Kind kind) {
  std::vector<std::string> texts;
  for (const Note& note : notes)
    if (note.kind == kind)
      texts.push_back(note.text);
  return texts;
}

std::string shortfall_text(const std::vector<Note>& notes) {
  return boost::algorithm::join(texts_of(notes, Note::Kind::shortfall), "; ");
}

} // namespace rollwave
