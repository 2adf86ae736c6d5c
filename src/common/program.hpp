#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/job.hpp"

namespace dim {

/// Exit status, the same in all four programs.
enum class Exit {
  done = 0,
  check_failed = 1,
  usage = 2,
  input = 3,
  system = 4,
  internal = 5,
  interrupted = 130
};

inline constexpr const char* kWritingStage = "write";  ///< once it ends, the result is written

/// What the programs have in common: options of the same names, messages, progress, statistics, exit status.
class Program {
 public:
  /// @param example  a working command line for the end of --help
  /// @param formats  "file formats: ..." for --version; the end of --help says where they are described
  Program(std::string name, const std::string& description, const std::string& example,
          const std::string& formats);

  CLI::App& app() { return app_; }

  /// Adds a command: its help ends with the example and the exit status, as the program's own does.
  CLI::App* add_command(const std::string& name, const std::string& what, const std::string& example);

  /// Adds --quiet, --verbose, --threads, --progress, --stats and --version to an app or subcommand.
  /// @param stats_taken  the command has a --stats of its own; ours is then --run-stats alone
  void add_common_options(CLI::App& app, bool stats_taken = false);

  /// Parses and runs `work`, whose result is the exit status; turns errors into messages and exit status.
  int run(int argc, char** argv, const std::function<Exit()>& work);

  /// Progress, interruption and memory limit for the library.
  Job job();

  /// Refuses, before any work, an output that cannot be written or that would replace an input or the
  /// statistics; `-` and special files are not looked at.
  /// @throws UsageError, IoError
  void check_output(const std::string& path, const std::vector<std::string>& inputs) const;

  /// A line on stderr unless --quiet; `verbose` only with --verbose.
  void say(const std::string& text) const;
  void say_verbose(const std::string& text) const;
  void warn(const Warnings& warnings) const;

  /// Starts the clock of a stage, ending the one before.
  void stage(const std::string& name);
  /// Threads that long work may use.
  int n_threads() const;
  /// Seconds since the program began.
  double elapsed_s() const;
  /// What --stats writes, to be added to.
  nlohmann::json& stats() { return *stats_; }
  bool quiet() const { return quiet_; }

 private:
  void apply_options();
  void refuse_unknown_command(const std::string& word) const;
  std::string parse_problem(const CLI::ParseError& error, const std::string& first_word) const;
  void write_stats();
  int fail(Exit status, const std::string& text) const;
  int fail(const InputError& error) const;

  std::string name_;
  std::string version_;
  CLI::App app_;
  bool quiet_ = false;
  bool verbose_ = false;
  int threads_ = 0;
  std::string progress_ = "auto";
  std::string stats_path_;
  std::shared_ptr<nlohmann::json> stats_;
  std::shared_ptr<struct ProgressLine> line_;
  std::shared_ptr<struct ThreadLimit> thread_limit_;
  std::shared_ptr<struct StageClock> clock_;
};

/// Peak resident memory of this process so far, bytes.
std::size_t peak_memory_bytes();

/// Has large blocks of memory that are freed kept for the next ones, in place of being handed back and cleared anew by
/// the system each time.
void keep_freed_memory();
/// Memory that can still be had, bytes.
std::size_t free_memory_bytes();

/// @throws UsageError  when `path` is "-" and standard output is a terminal
void refuse_terminal(const std::string& path, const std::string& what);

/// The command line asks for something it must not.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// Folder of the running executable.
std::string executable_folder();

}  // namespace dim
