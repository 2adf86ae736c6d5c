#include "common/interruption.hpp"

#include <semaphore.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <mutex>
#include <thread>
#include <vector>

#include "common/program.hpp"

namespace dim {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kPatience_s = 1;

std::atomic<bool> stop_requested{false};
std::atomic<bool> written{false};
sem_t end_now;
std::mutex outputs_mutex;
std::vector<std::string> outputs;

void on_signal(int) {
  if (stop_requested.exchange(true))
    sem_post(&end_now);
  else
    alarm(kPatience_s);
}

void on_alarm(int) { sem_post(&end_now); }

// AtomicFile writes to `.NAME.PID-N.tmp` beside the file that NAME stands for.
void remove_temporaries(const std::string& output) {
  std::error_code error;
  auto target = fs::weakly_canonical(output, error);
  if (error) target = output;
  const std::string own = "." + std::to_string(getpid()) + "-";
  const auto folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::vector<fs::path> found;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with('.') && name.ends_with(".tmp") && name.find(own) != std::string::npos)
      found.push_back(entry->path());
  }
  for (const auto& path : found) fs::remove(path, error);
}

// A thread, not a signal handler: it may look into folders, and no long call elsewhere holds it up.
[[noreturn]] void wait_for_the_end(const std::string& program) {
  while (sem_wait(&end_now) != 0) {
  }
  const std::scoped_lock lock(outputs_mutex);
  for (const auto& output : outputs) remove_temporaries(output);
  std::cerr << program << ": error: interrupted" << (written ? "\n" : "; nothing was written\n")
            << std::flush;
  _exit(static_cast<int>(Exit::interrupted));
}

void start_ender(const std::string& program) {
  sem_init(&end_now, 0, 0);
  // Signals are for the other threads, whose waiting for pipes they end.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread(wait_for_the_end, program).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace

std::atomic<bool>& stop_flag() { return stop_requested; }

void answer_interruptions(const std::string& program) {
  start_ender(program);
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = on_alarm;
  sigaction(SIGALRM, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

void note_output(const std::string& path) {
  if (path.empty() || path == "-") return;
  const std::scoped_lock lock(outputs_mutex);
  outputs.push_back(path);
}

void note_written() { written = true; }

}  // namespace dim
