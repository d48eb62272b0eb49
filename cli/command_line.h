// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "option_values.h"

namespace cli {

/// What the help says beside the options.
struct CommandText {
    std::string name;    ///< what is typed before the options: `droplet-shape`, `droplet-shape batch`
    std::string title;   ///< a line on what it does
    std::string usage;   ///< what follows the name: `[OPTIONS] INPUT OUTPUT`
    std::string footer;  ///< units, examples, exit codes
};

/// The options given on the command line and in the configuration file, the former going before the latter.
///
/// A command declares its options, parses, and then asks for them one by one. Every option but a flag takes one value
/// and may be given once.
class CommandLine {
public:
    explicit CommandLine(const CommandText& text);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// An option with a value.
    /// @param group  heading in the help
    /// @param names  such as `--width` or `-j,--threads`
    /// @param type   name of its value in the help, or the words it may be: `LENGTH`, `linear|exact`, `V|every`
    /// @param description  ends in its default, in brackets
    void add(const char* group, const char* names, const char* type, const std::string& description);
    /// An option that may be given several times.
    void addList(const char* group, const char* names, const char* type, const std::string& description);
    void addFlag(const char* group, const char* names, const std::string& description);
    /// An argument without a name of its own, in the order of the calls.
    void addArgument(const char* name, const std::string& description);
    /// Arguments without names of their own, any number of them, after which there are no others.
    void addArguments(const char* name, const std::string& description);
    /// Options of which one at most may be given.
    void exclude(const std::vector<std::string>& names);

    /// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
    void parse(int argc, const char* const* argv);

    /// Whether an option of that name is declared.
    [[nodiscard]] bool knows(const std::string& name) const;
    [[nodiscard]] bool flag(const std::string& name) const;
    [[nodiscard]] std::optional<Given> value(const std::string& name) const;
    /// Every value of an option that may be given several times, or of arguments, in their order.
    [[nodiscard]] std::vector<Given> values(const std::string& name) const;
    /// The argument of that name.
    /// @throws droplet::Error InvalidArgument: missing or empty
    [[nodiscard]] std::string argument(const std::string& name) const;
    /// Every option given, and its values, in the order of their declaration; a flag's is `true`. Arguments are not
    /// among them.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> given() const;
    [[nodiscard]] std::string help() const;

private:
    class Parser;
    std::unique_ptr<Parser> parser_;
};

}  // namespace cli
