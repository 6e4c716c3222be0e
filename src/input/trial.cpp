// SPDX-License-Identifier: Apache-2.0
#include "input/trial.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <initializer_list>
#include <new>

#include "base/error.hpp"

namespace cloudgen::input {
namespace {

/// Damage that sends a library round in circles ends here.
constexpr unsigned kMostSeconds = 60;
/// Damage that makes a library ask for all memory ends here.
constexpr rlim_t kMostBytes = rlim_t{4} << 30;

/// Beyond what the process has already. Sanitizers map terabytes, and are left alone.
void limitMemory() {
#ifndef __SANITIZE_ADDRESS__
  std::ifstream sizes("/proc/self/statm");
  rlim_t pages = 0;
  if (!(sizes >> pages)) return;
  const rlim_t most = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kMostBytes;
  const rlimit memory{most, most};
  setrlimit(RLIMIT_AS, &memory);
#endif
}

[[noreturn]] void runAlone(const std::function<void()>& work) {
  const rlimit noCoreFile{0, 0};
  setrlimit(RLIMIT_CORE, &noCoreFile);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGALRM, SIGTERM})
    std::signal(number, SIG_DFL);
  alarm(kMostSeconds);
  limitMemory();
  try {
    work();
  } catch (const std::bad_alloc&) {
    _exit(1);
  } catch (...) {  // the parent meets the same and says it
  }
  _exit(0);
}

}  // namespace

void tryInChild(const std::string& name, const std::string& library, const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) runAlone(work);
  if (child < 0) return;  // no process to be had: the file is read without the trial
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw base::InputError(name, "is damaged in a way that the " + library + " library does not survive",
                         "fetch the file again");
}

}  // namespace cloudgen::input
