#include "lab/judge/program.h"

#include <fmt/format.h>

#ifndef _WIN32
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#endif

namespace fb::lab {

#ifdef _WIN32

Result<ProgramEnd> run_program(const std::vector<std::string>& arguments) {
  return Error{fmt::format("{}: no program can be started on this system yet", arguments.front())};
}

#else

namespace {

// Descriptors that are closed when they go out of scope.
struct Pipe {
  std::array<int, 2> ends{-1, -1};  // to read from, to write to
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  void close_end(std::size_t index) {
    if (ends[index] >= 0) ::close(ends[index]);
    ends[index] = -1;
  }
};

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t count = ::read(descriptor, part.data(), part.size());
    if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

constexpr int kNotStarted = 127;  // as shells say it

// In the child: becomes the program, with both outputs into the pipe, and ends when its parent does.
[[noreturn]] void become(char* const* arguments, int output) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing >= 0) ::dup2(nothing, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  ::execvp(arguments[0], arguments);
  ::_exit(kNotStarted);
}

}  // namespace

Result<ProgramEnd> run_program(const std::vector<std::string>& arguments) {
  const auto failure = [&](const char* why) {
    return Error{fmt::format("{}: cannot be started: {}", arguments.front(), why)};
  };
  Pipe pipe;
  if (::pipe2(pipe.ends.data(), O_CLOEXEC) != 0) return failure(std::strerror(errno));
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv;
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) return failure(std::strerror(errno));
  if (child == 0) become(argv.data(), pipe.ends[1]);
  pipe.close_end(1);
  ProgramEnd end;
  end.output = read_all(pipe.ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return failure(std::strerror(errno));
  end.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (end.status == kNotStarted && end.output.empty()) return failure("there is no such program");
  return end;
}

#endif

}  // namespace fb::lab
