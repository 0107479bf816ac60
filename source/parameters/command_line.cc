#include "rollwave/parameters/command_line.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/parameters.h"

#include <boost/algorithm/string/predicate.hpp>

#include <sstream>

namespace rollwave {

std::string usage() {
  return R"(Rollwave computes the steady rolling of an elastic cylinder on a road.

Usage:
  rollwave FILE.prm [OPTIONS]
  mpirun -np N rollwave ...   the same on N processes
  rollwave --parameters [FILE.prm]   print a complete commented parameter file
  rollwave --quantities   print the names and units of all results
  rollwave --help         print this text
  rollwave --version      print the versions of Rollwave and deal.II

Options:
  --verify                    compare the results with the exact solution of the scene
  --part K/N                  make every N-th run of a study, beginning with the K-th; the same
                              command without it joins the parts
  --output DIR                output directory instead of Output/Directory
  --set "Section/Key=value"   overrides the file; may be repeated, the last one holds

Exit codes: 0 solved, 1 bad input, 2 not solved, 3 not written.
)";
}

namespace {

/// "K/N" with 1 <= K <= N. @throws BadInput
StudyPart parse_part(const std::string& text) {
  StudyPart part;
  char slash = 0, rest = 0;
  std::istringstream in(text);
  if (in >> part.number >> slash >> part.count && slash == '/' && !(in >> rest) &&
      text.find('-') == std::string::npos && 1 <= part.number && part.number <= part.count)
    return part;
  throw BadInput("--part " + in_quotes(text) +
                 " is not of the form K/N with 1 <= K <= N, as in --part 1/4");
}

} // namespace

CommandLine read_command_line(const std::vector<std::string>& arguments) {
  CommandLine line;
  for (auto argument = arguments.begin(); argument != arguments.end(); ++argument) {
    // "--output DIR" and "--output=DIR"
    const auto takes_value = [&](const std::string& option) {
      return *argument == option || boost::algorithm::starts_with(*argument, option + '=');
    };
    const auto option_value = [&]() {
      if (const auto equals = argument->find('='); equals != std::string::npos)
        return argument->substr(equals + 1);
      const std::string option = *argument;
      if (++argument == arguments.end() || boost::algorithm::starts_with(*argument, "-"))
        throw BadInput(option + " needs a value after it; see rollwave --help");
      return *argument;
    };
    if (*argument == "--help" || *argument == "-h")
      line.action = CommandLine::Action::help;
    else if (*argument == "--version")
      line.action = CommandLine::Action::version;
    else if (*argument == "--parameters")
      line.action = CommandLine::Action::parameters;
    else if (*argument == "--quantities")
      line.action = CommandLine::Action::quantities;
    else if (*argument == "--verify")
      line.verify = true;
    else if (takes_value("--part"))
      line.part = parse_part(option_value());
    else if (takes_value("--output"))
      line.settings.push_back({"Output", "Directory", option_value(), "--output"});
    else if (takes_value("--set"))
      line.settings.push_back(parse_setting(option_value(), "--set"));
    else if (argument->size() > 1 && argument->front() == '-')
      throw BadInput("unknown option " + printable(*argument) + "; see rollwave --help");
    else if (!line.file.empty())
      throw BadInput("one parameter file at a time: " + printable(line.file.string()) + " or " +
                     printable(*argument) + "; a key is set by --set \"Section/Key=value\"");
    else
      line.file = *argument;
  }
  if (line.action == CommandLine::Action::run && line.file.empty())
    throw BadInput("no parameter file given\n\n" + usage());
  return line;
}

std::vector<Setting> settings_of(const CommandLine& line, MPI_Comm communicator) {
  std::vector<Setting> settings;
  if (!line.file.empty()) {
    settings = read_settings(line.file, communicator);
    if (!last_of(settings, "Output/Directory") && !last_of(line.settings, "Output/Directory"))
      settings.push_back(
          {"Output", "Directory", "output/" + line.file.stem().string(),
           "default from the name of " + printable(line.file.string()) + " without --output"});
  }
  settings.insert(settings.end(), line.settings.begin(), line.settings.end());
  return settings;
}

} // namespace rollwave
