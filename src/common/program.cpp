#include "common/program.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/version.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/atomic_file.hpp"
#include "base/version.hpp"
#include "common/files.hpp"
#include "common/interruption.hpp"
#include "common/progress_line.hpp"

namespace dim {
namespace {

constexpr const char* kExitCodes =
    "Exit status: 0 done, 1 result written but a requested check failed, 2 command line wrong,\n"
    "3 input wrong, 4 file or system, 5 internal error, 130 interrupted.";

// Where the file formats are described: installed with the program, else in the source folder.
std::string documents() {
  for (const char* folder : {"/../share/doc/dim", "/../share/dim/docs"}) {
    std::error_code error;
    const auto path = std::filesystem::path(executable_folder() + folder).lexically_normal();
    if (std::filesystem::is_directory(path, error)) return path.string();
  }
  return "docs";
}

constexpr const char* kVersionHelp = "Print version, compiler and file formats";

std::string footer(const std::string& example) {
  return fmt::format(
      "Example:\n{}\n\n{}\n\nFile formats: zone-and-lights.md, databases.md and formats.md in {}", example,
      kExitCodes, documents());
}

std::string version_text(const std::string& name, const std::string& formats) {
  return fmt::format("{} {}\ncompiler {} {}\nlibraries fmt {}.{}, oneTBB {}, nlohmann-json {}.{}\n{}", name,
                     version(),
#ifdef __clang__
                     "clang",
#else
                     "gcc",
#endif
                     __VERSION__, FMT_VERSION / 10000, FMT_VERSION / 100 % 100, TBB_VERSION_STRING,
                     NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, formats);
}

}  // namespace

struct ThreadLimit {
  tbb::global_control control;
  explicit ThreadLimit(int n)
      : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n)) {}
};

struct StageClock {
  using Clock = std::chrono::steady_clock;
  Clock::time_point start = Clock::now();
  Clock::time_point stage_start = start;
  std::string stage;
  static double seconds(Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
  }
};

Program::Program(std::string name, const std::string& description, const std::string& example,
                 const std::string& formats)
    : name_(std::move(name)),
      version_(version_text(name_, formats)),
      app_(description, name_),
      stats_(std::make_shared<nlohmann::json>()),
      clock_(std::make_shared<StageClock>()) {
  app_.footer(footer(example));
  app_.set_version_flag("--version", version_, kVersionHelp);
  app_.set_help_flag("--help,-h", "Print this help");
  app_.get_formatter()->column_width(34);
  app_.option_defaults()->always_capture_default();
}

CLI::App* Program::add_command(const std::string& name, const std::string& what, const std::string& example) {
  auto* command = app_.add_subcommand(name, what);
  command->footer(footer(example));
  return command;
}

void Program::add_common_options(CLI::App& app, bool stats_taken) {
  if (&app != &app_) app.set_version_flag("--version", version_, kVersionHelp);
  app.add_flag("--quiet,-q", quiet_, "No messages but errors")->group("Messages");
  app.add_flag("--verbose,-v", verbose_, "Say what is done")->group("Messages");
  app.add_option("--progress", progress_, "Progress bar: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->group("Messages");
  app.add_option("--threads,-j", threads_, "Threads; 0 = all cores")
      ->check(CLI::Range(0, 1024))
      ->group("Running");
  // `dimout grid` has its own --stats (of the planes): there only the longer name is left.
  app.add_option(stats_taken ? "--run-stats" : "--stats,--run-stats", stats_path_,
                 "Write counts, seconds, memory and energy as JSON to this file")
      ->type_name("FILE")
      ->group("Running");
}

void Program::apply_options() {
  if (threads_ > 0) thread_limit_ = std::make_shared<ThreadLimit>(threads_);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!quiet_ && progress_ != "never" && (progress_ == "always" || terminal))
    line_ = std::make_shared<ProgressLine>(name_, progress_ == "always");
  if (stats_path_.empty()) return;
  refuse_unwritable(stats_path_);
  note_output(stats_path_);
}

int Program::run(int argc, char** argv, const std::function<Exit()>& work) {
  keep_freed_memory();
  try {
    if (argc > 1) refuse_unknown_command(argv[1]);
    app_.parse(argc, argv);
  } catch (const UsageError& error) {
    return fail(Exit::usage, error.what());
  } catch (const CLI::Success& success) {
    const int status = app_.exit(success);
    if (std::cout.flush()) return status;
    return fail(Exit::system, fmt::format("standard output: cannot write: {}", std::strerror(errno)));
  } catch (const CLI::ParseError& error) {
    return fail(Exit::usage, parse_problem(error, argc > 1 ? argv[1] : ""));
  }
  int status = 0;
  try {
    answer_interruptions(name_);
    apply_options();
    status = static_cast<int>(work());
    stage("");
    write_stats();
    return status;
  } catch (const UsageError& error) {
    return fail(Exit::usage, error.what());
  } catch (const InputError& error) {
    return fail(error);
  } catch (const IoError& error) {
    return fail(Exit::system, error.what());
  } catch (const LimitError& error) {
    return fail(Exit::system, error.what());
  } catch (const Interrupted&) {
    return fail(Exit::interrupted, "interrupted; nothing was written");
  } catch (const std::bad_alloc&) {
    return fail(Exit::system, "out of memory; use larger cells, fewer patches or fewer sources");
  } catch (const std::system_error& error) {
    return fail(Exit::system, fmt::format("the system refuses: {}", error.what()));
  } catch (const std::exception& error) {
    return fail(Exit::internal, fmt::format("internal error, please report: {}", error.what()));
  }
}

// Without this the parser takes a misspelt command for the input file, or says only that one is needed.
void Program::refuse_unknown_command(const std::string& word) const {
  std::vector<std::string> known;
  for (const auto* command : app_.get_subcommands(nullptr)) known.push_back(command->get_name());
  if (known.empty() || word.empty() || word.front() == '-' || std::count(known.begin(), known.end(), word))
    return;
  const bool command_needed = app_.get_require_subcommand_min() > 0;
  std::error_code error;
  const bool like_a_file =
      word.find_first_of("./") != std::string::npos || std::filesystem::exists(word, error);
  const std::string near = did_you_mean(word, known);
  if (!command_needed && (like_a_file || near.empty())) return;
  throw UsageError(
      fmt::format("there is no command '{}'\n        {}", word,
                  near.empty() ? fmt::format("the commands are {}", fmt::join(known, ", ")) : near));
}

// The parser's words, and for a word it does not know the nearest option or command that it does.
std::string Program::parse_problem(const CLI::ParseError& error, const std::string& first_word) const {
  const CLI::App* command = &app_;
  if (const auto parsed = app_.get_subcommands(); !parsed.empty()) command = parsed.front();
  std::string cure =
      fmt::format("see '{} --help'", command == &app_ ? name_ : name_ + " " + command->get_name());
  const bool unknown_word = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  auto words = unknown_word ? command->remaining() : std::vector<std::string>{};
  // A misspelt command is taken for the input file, and the file after it is then the word too many.
  if (unknown_word && command == &app_) words.push_back(first_word);
  std::vector<std::string> known;
  for (const auto* option : command->get_options())
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  for (const auto* other : app_.get_subcommands(nullptr)) known.push_back(other->get_name());
  for (const auto& word : words) {
    const std::string hint = did_you_mean(word.substr(0, word.find('=')), known);
    if (!hint.empty()) cure = hint;
  }
  return fmt::format("{}\n        {}", error.what(), cure);
}

int Program::fail(Exit status, const std::string& text) const {
  if (line_) line_->clear();
  std::cerr << name_ << ": error: " << text << '\n';
  return static_cast<int>(status);
}

int Program::fail(const InputError& error) const {
  if (line_) line_->clear();
  for (const auto& problem : error.problems())
    std::cerr << name_ << ": error: " << to_string(problem) << '\n';
  if (error.n_found() > error.problems().size())
    std::cerr << name_ << ": error: and " << error.n_found() - error.problems().size() << " more\n";
  return static_cast<int>(Exit::input);
}

Job Program::job() {
  Job job;
  job.stop = &stop_flag();
  job.memory_limit_bytes = free_memory_bytes();
  if (line_)
    job.progress = [line = line_](const char* stage, double fraction) { line->show(stage, fraction); };
  return job;
}

void Program::check_output(const std::string& path, const std::vector<std::string>& inputs) const {
  if (path == "-") {
    if (stats_path_ == "-") throw UsageError("the result and --stats cannot both go to standard output");
    return;
  }
  auto others = inputs;
  if (!stats_path_.empty()) others.push_back(stats_path_);
  for (const auto& other : others)
    if (is_same_file(path, other))
      throw UsageError(
          fmt::format("'{}' would be replaced by the result\n        give -o another name", other));
  for (const auto& input : inputs)
    if (is_same_file(stats_path_, input))
      throw UsageError(
          fmt::format("'{}' would be replaced by the statistics; give --stats another name", input));
  refuse_unwritable(path);
}

void Program::say(const std::string& text) const {
  if (quiet_) return;
  if (line_) line_->clear();
  std::cerr << name_ << ": " << text << '\n';
}

void Program::say_verbose(const std::string& text) const {
  if (verbose_) say(text);
}

void Program::warn(const Warnings& warnings) const {
  if (quiet_) return;
  if (line_) line_->clear();
  for (const auto& warning : warnings) std::cerr << name_ << ": warning: " << to_string(warning) << '\n';
}

void Program::stage(const std::string& name) {
  if (!clock_->stage.empty()) {
    const double seconds = StageClock::seconds(clock_->stage_start);
    (*stats_)["seconds"][clock_->stage] = seconds;
    say_verbose(fmt::format("{}: {:.3f} s", clock_->stage, seconds));
  }
  if (line_) line_->clear();
  if (clock_->stage == kWritingStage) note_written();
  clock_->stage = name;
  clock_->stage_start = StageClock::Clock::now();
}

int Program::n_threads() const {
  return threads_ > 0 ? threads_ : static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

double Program::elapsed_s() const { return StageClock::seconds(clock_->start); }

void Program::write_stats() {
  if (stats_path_.empty()) return;
  auto& stats = *stats_;
  stats["program"] = name_;
  stats["version"] = version();
  stats["seconds"]["total"] = StageClock::seconds(clock_->start);
  stats["peak_memory_bytes"] = peak_memory_bytes();
  write_file(stats_path_, stats.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace dim
