// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_terms.h"
#include "option_target.h"
#include "option_values.h"

namespace cli {

/// Texts of the help, beside the options.
struct CommandText {
    std::string name;    ///< command: `droplet-shape`, `droplet-shape batch`
    std::string title;   ///< one line on what the command does
    std::string usage;   ///< arguments: `[OPTIONS] INPUT OUTPUT`
    std::string footer;  ///< units, examples, exit codes
    /// Commands of the program and what they do, before the footer.
    std::vector<std::pair<std::string, std::string>> commands = {};
};

/// Options from the command line and the configuration file; the command line takes precedence.
///
/// Precedence and exclusion hold for options by all their names. A word by which the help states the default of a value
/// that is not a word, such as `[none]`, may be given, and means the default.
///
/// A command declares its options, each with the variable that it is read into or without, parses, and then reads.
/// Every option but a flag takes one value, and may be given once.
class CommandLine {
public:
    explicit CommandLine(const CommandText& text);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// Declares an option with a value.
    /// @param group        heading in the help
    /// @param names        such as `--width` or `-j,--threads`; after a comma also an earlier name, `--new,--old`, that
    ///                     stays accepted and is not shown
    /// @param type         name of the value in the help, or the allowed words: `LENGTH`, `linear|exact`, `V|every`
    /// @param description  ends with the default value, in brackets
    void add(const char* group, const char* names, const char* type, const std::string& description);
    /// Declares an option that read() reads. Its default is the target's, unless the description ends with one.
    void add(const char* group, const char* names, const char* type, const std::string& description,
             OptionTarget target);
    /// Declares an option whose values are the words of its target.
    void add(const char* group, const char* names, const std::string& description, OptionTarget target);
    /// Declares an option that may be given several times.
    void addList(const char* group, const char* names, const char* type, const std::string& description);
    /// Declares an option without a value.
    void addFlag(const char* group, const char* names, const std::string& description);
    /// Declares a flag that read() reads.
    void addFlag(const char* group, const char* names, const std::string& description, bool& value);
    /// Declares a positional argument; arguments come in the order of the calls.
    void addArgument(const char* name, const std::string& description);
    /// Declares any number of positional arguments; they must be the last.
    void addArguments(const char* name, const std::string& description);
    /// Declares that at most one of these options may be given.
    void exclude(const std::vector<std::string>& names);

    /// Declares that these words, given to one option, are values of another.
    void moveWords(const char* from, const std::vector<std::string>& words, const char* to);

    /// Parses the command line, and reads the configuration file that --config names.
    /// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
    void parse(int argc, const char* const* argv);

    /// Reads all given options that have targets, in the order of their declaration.
    /// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
    void read() const;

    /// Whether an option of this name is declared.
    [[nodiscard]] bool knows(const std::string& name) const;
    /// Whether a flag is given, and true.
    [[nodiscard]] bool flag(const std::string& name) const;
    /// Value of an option, if it is given.
    [[nodiscard]] std::optional<Given> value(const std::string& name) const;
    /// All values of an option that may be given several times, or of arguments, in order.
    [[nodiscard]] std::vector<Given> values(const std::string& name) const;
    /// Argument of this name.
    /// @throws droplet::Error InvalidArgument: missing or empty
    [[nodiscard]] std::string argument(const std::string& name) const;
    /// Given options and their values, in the order of declaration, without arguments. The value of a flag is `true`.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> given() const;
    /// Options for messages.
    [[nodiscard]] CommandTerms terms() const;
    /// Text that --help prints.
    [[nodiscard]] std::string help() const;
    /// The same for programs, as JSON, schema `droplet-shape.help/1`: names, kinds of values, units, words, defaults.
    [[nodiscard]] std::string helpJson() const;
    /// Text of --help or --help=json; none if neither is given.
    [[nodiscard]] std::optional<std::string> requestedHelp() const;

private:
    class Parser;
    std::unique_ptr<Parser> parser_;
};

}  // namespace cli
