#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes completions of the program for bash, zsh and fish, from what --help says of its commands.

usage: packaging/completions.py PROGRAM FOLDER      makes pgdr.bash, _pgdr and pgdr.fish in FOLDER
"""
import re
import subprocess
import sys
from pathlib import Path

# What follows an option that does not name a file.
CHOICES = {
    "--placement": "lazy circumcenter type1 type2",
    "--gmsh-format": "4.1 4.1-ascii 2.2",
    "--nested": "fill alternate",
    "--markers-from": "names colors nothing",
    "--order": "1 2",
}
FILES = ("FILE", "OUT", "INPUT")


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True).stdout


def commands_of(program):
    """Each command with its description."""
    part = help_of(program).partition("Subcommands:\n")[2].partition("\n\n")[0]
    return dict(re.findall(r"^  (\w+) +(.*)$", part, re.M))


def options_of(program, command):
    """Each option as (names, argument or None, description)."""
    part = help_of(program, command).partition("\nOptions:\n")[2]
    found = re.findall(r"^  (-\S+)( [A-Z]\S*)?(?: \.\.\.)?(?: REQUIRED)?\s+(.+)$", part, re.M)
    return [(names.split(","), argument.strip() or None, text) for names, argument, text in found]


def bash(options):
    lines = ["_pgdr() {", '  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}', "  COMPREPLY=()"]
    lines.append(f'  if ((COMP_CWORD == 1)); then COMPREPLY=($(compgen -W "{" ".join(options)} --help --version" -- "$word")); return; fi')
    lines.append('  case "$before" in')
    lines += [f'    {name}) COMPREPLY=($(compgen -W "{words}" -- "$word")); return ;;' for name, words in CHOICES.items()]
    lines += ["  esac", '  if [[ $word == -* ]]; then', '    case "${COMP_WORDS[1]}" in']
    for command, known in options.items():
        names = " ".join(name for names, _, _ in known for name in names)
        lines.append(f'      {command}) COMPREPLY=($(compgen -W "{names}" -- "$word")) ;;')
    lines += ["    esac", "    return", "  fi", '  COMPREPLY=($(compgen -f -- "$word"))', "}", "complete -o filenames -F _pgdr pgdr"]
    return "\n".join(lines) + "\n"


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def zsh(commands, options):
    lines = ["#compdef pgdr", "local -a commands=("]
    lines += [f"  {quoted(name + ':' + text)}" for name, text in commands.items()]
    lines += [")", "if ((CURRENT == 2)); then _describe command commands; return; fi", 'case "$words[2]" in']
    for command, known in options.items():
        lines.append(f"  {command}) shift words; ((CURRENT--)); _arguments \\")
        for names, argument, text in known:
            text = re.sub(r"[\[\]:]", "", text)
            follows = "" if argument is None else f":{argument.lower()}:" + (
                f"({CHOICES[names[-1]]})" if names[-1] in CHOICES else "_files" if argument in FILES or argument.startswith("FILE") else " ")
            follows = follows.replace("::", ":") if argument is None else follows
            lines += [f"    {quoted('*' + name + '[' + text + ']' + follows)} \\" for name in names]
        lines.append("    '*:file:_files' ;;")
    return "\n".join(lines + ["esac"]) + "\n"


def fish(commands, options):
    lines = [f"complete -c pgdr -n __fish_use_subcommand -f -a {name} -d {quoted(text)}" for name, text in commands.items()]
    for command, known in options.items():
        for names, argument, text in known:
            line = f"complete -c pgdr -n '__fish_seen_subcommand_from {command}' -d {quoted(text)}"
            for name in names:
                line += f" -l {name[2:]}" if name.startswith("--") else f" -s {name[1:]}"
            if names[-1] in CHOICES:
                line += f" -x -a {quoted(CHOICES[names[-1]])}"
            elif argument is not None:
                line += " -r" if argument in FILES else " -x"
            lines.append(line)
    return "\n".join(lines) + "\n"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, folder = sys.argv[1], Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    commands = commands_of(program)
    options = {command: options_of(program, command) for command in commands}
    (folder / "pgdr.bash").write_text(bash(options))
    (folder / "_pgdr").write_text(zsh(commands, options))
    (folder / "pgdr.fish").write_text(fish(commands, options))


if __name__ == "__main__":
    main()
