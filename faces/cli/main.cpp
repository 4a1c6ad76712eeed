// SPDX-License-Identifier: Apache-2.0
// Runs sixstep on the command line: reads the arguments, calls one command, returns its exit code.
#include <unistd.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "faces/cli/completion_command.hpp"
#include "faces/cli/contest_command.hpp"
#include "faces/cli/curve_command.hpp"
#include "faces/cli/design_command.hpp"
#include "faces/cli/export_command.hpp"
#include "faces/cli/help_command.hpp"
#include "faces/cli/man_command.hpp"
#include "faces/cli/motor_command.hpp"
#include "faces/cli/new_command.hpp"
#include "faces/cli/plan_ranks.hpp"
#include "faces/cli/run_command.hpp"
#include "faces/cli/schema_command.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/cli/usage_error.hpp"
#include "files/controller_watch.hpp"
#include "files/temporary_names.hpp"
#include "files/text_file.hpp"
#include "text/escape/escape.hpp"

namespace cli {
namespace {

/// The command line in a form that a shell can read again. The program's name is without its path.
std::string retyped(int count, const char* const* words) {
  std::string text = "sixstep";
  for (int n = 1; n < count; ++n) text += " " + text::shell_word(words[n]);
  return text;
}

std::string exit_codes() {
  std::string text = "Exit codes:";
  for (const ExitMeaning& exit : exit_meanings)
    text += (text.back() == ':' ? " " : ", ") + std::to_string(static_cast<int>(exit.code)) + " " +
            std::string(exit.meaning);
  return text + "\n";
}

struct Listed {
  std::string_view name;
  Verb (*declare)(CLI::App& app);
  bool looks_at_all = false;  ///< true: the verb needs the declarations of all verbs
};
constexpr Listed listed[] = {{"new", declare_new},         {"run", declare_run},
                             {"design", declare_design},   {"compare", declare_contest},
                             {"curve", declare_curve},     {"export", declare_export},
                             {"help", declare_help, true}, {"motor", declare_motor},
                             {"schema", declare_schema},   {"completion", declare_completion, true},
                             {"man", declare_man, true}};

/// Declares the requested verb, or all verbs if `word` is not a verb. Declaring all verbs takes longer than
/// running many of them.
std::vector<Verb> declared(CLI::App& app, std::string_view word) {
  for (const Listed& verb : listed)
    if (verb.name == word && !verb.looks_at_all) return {verb.declare(app)};
  std::vector<Verb> all;
  for (const Listed& verb : listed) all.push_back(verb.declare(app));
  return all;
}

Exit run_program(int count, const char* const* words) {
  CLI::App app{"Brushless DC motor from data sheet to verified firmware", "sixstep"};
  app.set_version_flag("--version", std::string("sixstep ") + SIXSTEP_VERSION);
  app.require_subcommand(1);
  app.footer("To begin with: sixstep new first\n" + exit_codes());

  const std::vector<Verb> verbs = declared(app, count > 1 ? words[1] : "");
  if (count > 1 && words[1] == std::string_view(complete_word))
    return answer_shell(app, std::vector<std::string>(words + 2, words + count));

  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, count > 1 ? words[count - 1] : "");
  }
  const files::ReadLog inputs;  // logs the inputs, so that an output that would replace an input is refused
  const auto chosen = std::find_if(verbs.begin(), verbs.end(), [](const Verb& v) { return v.app->parsed(); });
  return exit_after_stop(chosen->call(retyped(count, words)));
}

/// Reports lack of memory without allocating memory.
Exit out_of_memory() {
  print("sixstep is out of memory; free memory, or reduce the work: fewer --jobs, a shorter run\n", stderr);
  return Exit::bad_input;
}

/// Ends the program at the failed allocation. A stream would catch std::bad_alloc, and a value read from the
/// stream would be reported as wrong.
[[noreturn]] void end_without_memory() {
  const Exit exit = out_of_memory();
  files::remove_temporary_files();
  ::_exit(static_cast<int>(exit));
}

/// Handles uncaught exceptions: lack of memory in a thread, or an internal error. After an internal error,
/// abort() preserves the stack trace.
[[noreturn]] void end_uncaught() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (...) {
  }
  std::abort();
}

/// Installs the handlers before the program's constants are initialised, because the initialisation allocates
/// memory.
[[gnu::constructor(101)]] void take_terminations() {
  std::set_terminate(end_uncaught);
  std::set_new_handler(end_without_memory);
}

int whole_program(int count, const char* const* words) {
  try {
    const auto program = [&] { return exit_after_printing(run_program(count, words)); };
    const bool makes_runs = count > 1 && words[1] == std::string_view("run");
    return static_cast<int>(makes_runs ? among_ranks(program) : program());
  } catch (const std::bad_alloc&) {
    return static_cast<int>(out_of_memory());
  } catch (const std::exception& error) {
    print("internal error: " + text::visible(error.what()) + "\n", stderr);
  } catch (...) {
    print("internal error\n", stderr);
  }
  return static_cast<int>(Exit::internal);
}

}  // namespace
}  // namespace cli

int main(int count, char** words) {
  cli::take_write_errors();
  cli::take_stop_signals();
  files::controllers_may_run();
  const int code = cli::whole_program(count, words);
  files::controllers_are_done();
  return code;
}
