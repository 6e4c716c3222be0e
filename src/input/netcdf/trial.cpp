// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/trial.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <initializer_list>

#include "base/error.hpp"

namespace cloudgen::input::netcdf {
namespace {

/// Damage that sends HDF5 round in circles ends here.
constexpr unsigned kMostSeconds = 60;

[[noreturn]] void runAlone(const std::function<void()>& work) {
  const rlimit noCoreFile{0, 0};
  setrlimit(RLIMIT_CORE, &noCoreFile);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGALRM, SIGTERM})
    std::signal(number, SIG_DFL);
  alarm(kMostSeconds);
  try {
    work();
  } catch (...) {  // the parent meets the same and says it
  }
  _exit(0);
}

}  // namespace

void tryInChild(const std::string& name, const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) runAlone(work);
  if (child < 0) return;  // no process to be had: the file is read without the trial
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw base::InputError(name, "is damaged in a way that the HDF5 library does not survive",
                         "fetch the file again");
}

}  // namespace cloudgen::input::netcdf
