// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a manual page: name, synopsis, options, commands, exit codes.
#include "Options/ManPage.h"
#include "Io/Text/NameList.h"
#include <algorithm>
#include <array>
#include <sstream>

namespace physvib {
namespace {

/// Escapes text for man: hyphens can be copied, and no line is read as a request.
std::string shown(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
            (out += "\\&") += c;
        else
            out += c;
    }
    return out;
}

std::string capitals(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
    return text;
}

void writeOption(std::ostream& out, const Option& option) {
    const std::string name = shown(joined(option.spellings, ", "));
    out << ".TP\n" << (option.isPlace ? "\\fI" : "\\fB") << name << "\\fR";
    if (!option.value().empty() && !option.isPlace) out << " \\fI" << shown(option.value()) << "\\fR";
    if (!option.initial.empty()) out << " (" << shown(option.initial) << ')';
    out << '\n' << shown(option.meaning) << '\n';
}

void writeInCall(std::ostream& out, const Option& option) {
    const std::string name = shown(option.spellings.back());
    out << (option.isRequired ? " " : " [")
        << (option.isPlace ? "\\fI" + name : "\\fB" + name + "\\fR \\fI" + shown(option.value()))
        << (option.isRequired ? "\\fR" : "\\fR]");
}

void writeCall(std::ostream& out, const OptionTable& command) {
    if (!command.usage.empty()) {
        out << ".nf\n" << shown(command.usage) << ".fi\n";
        return;
    }
    out << "\\fB" << shown(command.words) << "\\fR [\\fIoptions\\fR]";
    for (const Option& option : command.options)
        if (option.isPlace || option.isRequired) writeInCall(out, option);
    out << (command.commands.empty() ? "\n" : " \\fIcommand\\fR ...\n");
}

void writeOptions(std::ostream& out, const OptionTable& command) {
    for (const Option& option : command.options)
        if (!option.meaning.empty()) writeOption(out, option);
}

/// Commands of a program have pages of their own; subcommands are on the page of their command.
void writeCommands(std::ostream& out, const OptionTable& command) {
    if (command.commands.empty()) return;
    const bool isProgram = command.words.find(' ') == std::string::npos;
    out << ".SH COMMANDS\n";
    for (const OptionTable& inner : command.commands) {
        if (isProgram) {
            out << ".TP\n\\fB" << shown(pageName(inner)) << "\\fR(1)\n" << shown(inner.meaning) << '\n';
            continue;
        }
        out << ".SS " << shown(inner.words) << '\n' << shown(inner.meaning) << "\n.PP\n";
        writeCall(out, inner);
        writeOptions(out, inner);
    }
}

/// Introduction to a program or command, in addition to its one-line meaning.
struct Description {
    std::string_view page, text;
};
constexpr auto descriptions = std::to_array<Description>({
    {"physvib", "PhysVib turns physics collisions into vibrotactile signals. Each contact excites a decaying "
                "sinusoid, which is panned over 1 to 64 actuators so that it is felt at "
                "the contact point. physvib renders and plays scenes, runs and analyses perception studies, "
                "and measures materials and actuators. Begin with \"physvib scenes\" and "
                "\"physvib render shake-the-box --out box.wav\". Hands are attached to these motors: start "
                "with the amplifier at its lowest setting."},
    {"physvib-mixer", "Shows a physics world, plays it on the actuators that are attached, and mixes them "
                      "like the channels of an audio mixer. FILE.json is a session, a scene or a layout. "
                      "Without a device the world still runs and can be recorded. Esc silences everything "
                      "within a block. With two outputs and no actuators, the monitor plays what "
                      "would be felt on headphones."},
    {"physvib-render", "Simulates a scene, or reads an event list, a saved session or a haptic file, and "
                       "writes what each actuator plays: a WAV file with one channel per actuator, an event "
                       "list, a picture, a movie. It is faster than real time and repeatable: the same input "
                       "and options give the same bytes. All files appear at the end, or none."},
    {"physvib-play",
     "Plays a scene live on an audio device, a four-channel board, or both; or a sound file on a device. A "
     "contact is felt one constant output latency later, which is printed. Without --device and "
     "--board it lists the devices and a call to type. Ctrl-C silences the output at once and ends the "
     "program."},
    {"physvib-study", "Lists, shows and runs protocols of perception studies. In the mixer people answer; "
                      "here a simulated observer does, to rehearse a protocol and its analysis. An "
                      "interrupted run continues with the trial that was cut off."},
    {"physvib-analyse", "Analyses tables of trials: confusion matrices and information transfer, perceptual "
                        "resolution, choices, ratings, thresholds. Trials of a training are left out."},
    {"physvib-board", "Talks to the four-channel board over a serial port: its state, a self-test, and event "
                      "lists to play. The port is a path, or auto."},
});

std::string_view descriptionOf(std::string_view page) {
    const auto found = std::ranges::find(descriptions, page, &Description::page);
    return found == descriptions.end() ? std::string_view{} : found->text;
}

} // namespace

std::string pageName(const OptionTable& command) {
    std::string name = command.words;
    std::ranges::replace(name, ' ', '-');
    return name;
}

std::string manPage(const OptionTable& command, const std::vector<std::string>& pages) {
    std::ostringstream out;
    out << ".TH " << shown(capitals(pageName(command))) << " 1 \"\" \"PhysVib " << PHYSVIB_VERSION
        << "\" \"PhysVib\"\n.SH NAME\n"
        << shown(pageName(command)) << " \\- " << shown(command.meaning) << "\n.SH SYNOPSIS\n";
    writeCall(out, command);
    if (const auto text = descriptionOf(pageName(command)); !text.empty())
        out << ".SH DESCRIPTION\n" << shown(text) << '\n';
    if (std::ranges::any_of(command.options, [](const auto& option) { return !option.meaning.empty(); }))
        out << ".SH OPTIONS\n";
    writeOptions(out, command);
    writeCommands(out, command);
    out << ".SH EXIT STATUS\n0: done. 1: failed; one line says file, place and expectation. 2: a wrong "
           "call.\n.SH SEE ALSO\n";
    std::string others;
    for (const std::string& page : pages)
        if (page != pageName(command))
            others += (others.empty() ? "\\fB" : ", \\fB") + shown(page) + "\\fR(1)";
    out << others << (others.empty() ? "" : ".\n.br\n")
        << "The pages in \\fI/usr/share/doc/physvib/Docs\\fR.\n";
    return out.str();
}

} // namespace physvib
