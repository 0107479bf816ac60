#include "rollwave/plot/gnuplot.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"

#include <boost/algorithm/string/replace.hpp>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <map>
#include <string>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

/// Runs a command of the shell. Returns true if it succeeds. @param messages what it prints
bool run_shell(const std::string& command, std::string& messages) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (!pipe)
    return false;
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe))
    messages += buffer.data();
  return pclose(pipe) == 0;
}

} // namespace

std::string in_single_quotes(const std::string& text) {
  std::string line = boost::algorithm::replace_all_copy(text, "'", "''");
  for (char& letter : line)
    if (std::iscntrl(static_cast<unsigned char>(letter)))
      letter = ' '; // the end of a line would end the string
  return '\'' + line + '\'';
}

namespace {

constexpr double width_over_size = 0.76; // of a letter, as of wide fonts without serifs

}

unsigned int size_of_letters(double n_letters, double width, unsigned int largest) {
  return std::clamp<double>(width / (width_over_size * n_letters), 1, largest);
}

Title title_in_room(const std::string& text, unsigned int width) {
  constexpr unsigned int size = 12;
  const std::size_t most = width / (width_over_size * size);
  std::vector<std::string> lines;
  for (const std::string& paragraph : split(text, '\n')) {
    lines.emplace_back();
    for (std::size_t begin = 0; begin < paragraph.size();) {
      const std::size_t comma = paragraph.find(", ", begin),
                        end = comma == std::string::npos ? paragraph.size() : comma + 2;
      if (!lines.back().empty() && lines.back().size() + end - begin > most)
        lines.emplace_back();
      lines.back() += paragraph.substr(begin, end - begin);
      begin = end;
    }
  }
  std::size_t longest = 1;
  std::string title;
  for (const std::string& line : lines) {
    longest = std::max(longest, line.size());
    title += (title.empty() ? "" : ".\"\\n\".") + in_single_quotes(trimmed(line));
  }
  return {(title.empty() ? "''" : title) + " font '," +
              std::to_string(size_of_letters(longest, width, size)) + '\'',
          static_cast<unsigned int>(lines.size())};
}

namespace {

/// What a format means for gnuplot.
struct Terminal {
  std::string settings;  ///< of gnuplot's terminal
  std::string last_word; ///< of a complete file
};

Terminal terminal_of(PictureFormat format, const Picture& picture) {
  const auto size = [&](double factor, const std::string& unit) {
    return " noenhanced size " + rounded(factor * picture.width, 6) + unit + ',' +
           rounded(factor * picture.height, 6) + unit + " font 'Helvetica,14' ";
  };
  switch (format) {        // three points of cairo's fonts are four of SVG's pixels
  case PictureFormat::png: // twice as many points as an SVG picture has, for print
    return {"pngcairo" + size(2, "") + "fontscale 1.5 linewidth 2 pointscale 2", "IEND"};
  case PictureFormat::pdf:
    return {"pdfcairo" + size(1 / 72., "in") + "fontscale 0.75 linewidth 2 pointscale 1.5",
            "%%EOF"};
  case PictureFormat::svg:
    break;
  }
  return {"svg" + size(1, "") + "background rgb 'white' fixed", "</svg>"};
}

} // namespace

std::vector<std::string> picture_files(const std::string& name, PictureFormat format) {
  const std::map<PictureFormat, std::string> endings = {
      {PictureFormat::svg, ".svg"}, {PictureFormat::png, ".png"}, {PictureFormat::pdf, ".pdf"}};
  return {name + ".gp", name + endings.at(format)};
}

void draw(const std::vector<Picture>& pictures, const fs::path& directory, PictureFormat format,
          WrittenFiles& written) {
  for (const Picture& picture : pictures) {
    const auto names = picture_files(picture.name, format);
    written.write(directory / names[0],
                  "# gnuplot " + names[0] + " draws " + names[1] +
                      "\nif (!exists('picture')) picture = '" + names[1] + "'\nset terminal " +
                      terminal_of(format, picture).settings + "\nset output picture\n" +
                      picture.script + "set output\n");
  }
  const std::string change_directory =
      "cd '" + boost::algorithm::replace_all_copy(fs::absolute(directory).string(), "'", "'\\''") +
      "' && exec timeout -k 1 ";
  const dealii::Timer timer;
  for (const Picture& picture : pictures) {
    const auto names = picture_files(picture.name, format);
    const std::string &script = names[0], &name = names[1];
    AtomicFile file(directory / name);
    std::string messages;
    constexpr double most_seconds = 60; // for all pictures: gnuplot may wait for ever
    const double left = std::max(most_seconds - timer.wall_time(), 0.1);
    if (run_shell(change_directory + std::to_string(left) + " gnuplot -d -e \"picture='" +
                      file.part().filename().string() + "'\" " + script + " 2>&1",
                  messages)) {
      if (read_file(file.part()).find(terminal_of(format, picture).last_word) == std::string::npos)
        throw NotWritten((directory / name).string() +
                         " could not be written as a whole: the disk is full, or the size of files "
                         "is limited"); // of which gnuplot says nothing
      written.n_bytes += file.commit();
      written.files.push_back(directory / name);
    } else
      written.notes.push_back(
          {Note::Kind::remark,
           name + " was not drawn: gnuplot has " +
               (timer.wall_time() > most_seconds ? "taken more than a minute"
                                                 : "failed: " + printable(trimmed(messages))) +
               "; its script is " + script});
  }
}

} // namespace rollwave
