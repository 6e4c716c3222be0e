// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "base/text.hpp"
#include "cli/command.hpp"

namespace cloudgen::cli {
namespace {

volatile std::sig_atomic_t stopRequested = 0;

void requestStop(int) { stopRequested = 1; }

bool showsBar(Terminal::ProgressMode mode) {
  if (mode != Terminal::ProgressMode::Auto) return mode == Terminal::ProgressMode::Always;
  const char* kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) && kind && std::string_view(kind) != "dumb";
}

void drawBar(std::string_view stage, double share) {
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(share * kWidth);
  std::fprintf(stderr, "\r\x1b[K%-24.*s [%s%s] %3d %%", static_cast<int>(stage.size()), stage.data(),
               std::string(filled, '#').c_str(), std::string(kWidth - filled, '.').c_str(),
               static_cast<int>(share * 100));
  if (share >= 1) std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
}

}  // namespace

base::Progress Terminal::progress() const {
  std::signal(SIGINT, requestStop);
  std::signal(SIGTERM, requestStop);
  base::Progress progress;
  progress.cancelled = [] { return stopRequested != 0; };
  if (quiet) return progress;
  if (progressMode == ProgressMode::Json)
    progress.report = [](std::string_view stage, double share) {
      std::fprintf(stderr, "{\"stage\":\"%.*s\",\"share\":%s}\n", static_cast<int>(stage.size()),
                   stage.data(), base::shortest(share).c_str());
    };
  else if (showsBar(progressMode))
    progress.report = drawBar;
  return progress;
}

void Terminal::say(std::string_view text) const {
  if (!quiet) std::fprintf(stderr, "%.*s\n", static_cast<int>(text.size()), text.data());
}

void Terminal::warn(std::string_view text) const { say("warning: " + std::string(text)); }

void print(std::string_view text) { std::printf("%.*s\n", static_cast<int>(text.size()), text.data()); }

}  // namespace cloudgen::cli
