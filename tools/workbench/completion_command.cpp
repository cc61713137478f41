#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "engine/renderer/render_settings.h"
#include "tools/scenegen/scenes.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/layers.h"

namespace ag::workbench {
namespace {

std::string optionsOf(const CLI::App& command) {
    std::string names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            if (!option->get_group().empty()) names += " --" + name;
    return names;
}

// Words of the sub-command's options, of scenes where one is asked for, of values where an option knows them;
// files beside them.
std::string script(const CLI::App& program) {
    std::string commands, cases;
    for (const CLI::App* command : program.get_subcommands({})) {
        commands += (commands.empty() ? "" : " ") + command->get_name();
        cases += fmt::format("    {}) words=\"{}{}\" ;;\n", command->get_name(),
                             fmt::join(scenegen::sceneNames(), " "), optionsOf(*command));
    }
    return fmt::format(
        "# Completion of afterglow for bash: source <(afterglow completion)\n"
        "_afterglow() {{\n"
        "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=\n"
        "  COMPREPLY=()\n"
        "  if ((COMP_CWORD == 1)); then COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return; fi\n"
        "  case $before in\n"
        "    --preset) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n"
        "    --layer) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n"
        "  esac\n"
        "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
        "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\") $(compgen -f -- \"$word\"))\n"
        "}}\n"
        "complete -o filenames -F _afterglow afterglow\n",
        commands, fmt::join(render::presetNames(), " "), fmt::join(layerNames(), " "), cases);
}

}  // namespace

void addCompletionCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand(
        "completion", "a script that completes commands in bash: source <(afterglow completion)");
    command->callback([&program] { std::cout << script(program); });
}

}  // namespace ag::workbench
