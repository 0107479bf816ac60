#include "rollwave/base/written_files.h"

#include "rollwave/base/atomic_file.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>

namespace rollwave {

void WrittenFiles::write(const std::filesystem::path& path, const std::string& content) {
  n_bytes += write_file(path, content);
  files.push_back(path);
}

void WrittenFiles::write_parts(const std::filesystem::path& path, const std::string& part,
                               MPI_Comm communicator) {
  n_bytes += write_file_in_parts(path, part, communicator);
  files.push_back(path);
}

void WrittenFiles::note_older_files(const std::vector<std::filesystem::path>& older) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : older)
    if (std::find(files.begin(), files.end(), file) == files.end())
      names.push_back(file.filename().string());
  constexpr std::size_t most = 20;
  const std::size_t n_names = names.size();
  names.resize(std::min(most, n_names));
  if (n_names > 0)
    notes.push_back(
        {Note::Kind::remark,
         "older files in this directory: " + boost::algorithm::join(names, ", ") +
             (n_names > most ? " and " + std::to_string(n_names - most) + " more" : "")});
}

} // namespace rollwave
