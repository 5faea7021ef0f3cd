#include "run_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "ifsi/core/error.hpp"

namespace ifsi::detail {

RunOptions read_options(int argc, const char* const* argv, const std::string& name,
                        const std::string& description) {
  RunOptions o;
  o.out = "results/" + name;
  CLI::App app(description, name);
  app.set_help_flag();
  app.add_flag("-h,--help", o.help, "print this and the parameters of the case, and end");
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.add_option("--config", o.config, "TOML file with parameters of the case");
  app.add_option("--set", o.assignments, "key=value; wins over the file; may be given many times")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--out", o.out, "output folder")->capture_default_str();
  auto* restart =
      app.add_option("--restart", o.restart, "go on from a checkpoint, the latest when none is named")
          ->expected(0, 1);
  app.add_flag("-v,--verbose", o.verbose, "show every Newton iteration");
  app.add_flag("--describe", o.describe, "print the name and one line about the case, and end");
  app.add_flag("--params", o.params, "print every key: default, unit, range, help, and end");
  app.add_flag("--print-config", o.print_config, "print the parameters in effect as TOML, and end");
  app.add_flag("--check", o.check, "check the configuration only, and end");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    throw Error(ExitCode::configuration, std::string(e.what()) + "; " + name + " --help lists the options");
  }
  if (restart->count() > 0 && !o.restart) o.restart = "";
  o.help_text = app.help();
  return o;
}

}  // namespace ifsi::detail
