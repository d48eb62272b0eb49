// SPDX-License-Identifier: GPL-3.0-or-later
//
// CLI11 splits the command line and formats the help. This file parses values and words the error messages.
#include "command_line.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "config_file.h"
#include "droplet/version.h"
#include "value_kind.h"

namespace cli {
namespace {

constexpr std::size_t kColumn = 26;  // column of the descriptions
constexpr std::size_t kWidth = 80;

/// Breaks a description into lines that fit beside the names.
std::string wrapped(const std::string& text)
{
    std::istringstream words(text);
    std::string lines;
    std::size_t column = 0;
    for (std::string word; words >> word;) {
        if (column + 1 + word.size() > kWidth - kColumn) {
            lines += "\n";
            column = 0;
        } else if (column > 0) {
            lines += " ";
            ++column;
        }
        lines += word;
        column += word.size();
    }
    return lines;
}

/// Names of one meaning, of which a command has one at most; other programs use the others.
const std::vector<std::vector<std::string>>& synonyms()
{
    static const std::vector<std::vector<std::string>> groups{
        {"--time", "--duration", "--seconds"},
        {"--fps", "--frame-rate", "--framerate", "--rate"},
        {"--drops", "--particle-count", "--count", "--number"},
        {"--frame-size", "--preview-size", "--frame-width", "--resolution"},
        {"--codec", "--encoder"},
        {"--json", "--report"},
        {"--preview", "--render"},
        {"--rain", "--rainfall"},
        {"--seed", "--random-seed"},
        {"--speed", "--velocity"},
        {"--threads", "--jobs"},
        {"--wind-speed", "--wind-velocity"},
        {"--quiet", "--silent"},
        {"--no-clobber", "--no-overwrite"}};
    return groups;
}

/// The long name of an option; later ones are its former names.
std::string nameOf(const CLI::Option* option)
{
    return "--" + option->get_lnames().front();
}

/// Description of an option, without its default value.
struct Described {
    std::string text;
    std::string usual;  ///< default value; empty if there is none
};

Described described(const std::string& description)
{
    const std::size_t begin = description.rfind(" [");
    if (begin == std::string::npos || description.back() != ']') {
        return {description, ""};
    }
    return {description.substr(0, begin), description.substr(begin + 2, description.size() - begin - 3)};
}

/// Lines of a help's list of commands.
std::string listOf(const std::vector<std::pair<std::string, std::string>>& commands)
{
    std::string text;
    for (const auto& [name, title] : commands) {
        text += fmt::format("  {:<13}{}\n", name, title);
    }
    return text.empty() ? text : "Commands, each with a --help of its own:\n" + text + "\n";
}

class HelpFormatter : public CLI::Formatter {
public:
    explicit HelpFormatter(const CommandText& text) : usage_("\nUsage: " + text.name + " " + text.usage + "\n")
    {
        column_width(kColumn);
        label("Positionals", "Arguments");
    }

    std::string make_usage(const CLI::App* app, std::string /*name*/) const override
    {
        const bool has_arguments = !app->get_options([](const CLI::Option* o) { return o->get_positional(); }).empty();
        return has_arguments ? usage_ : usage_ + "\n";
    }

    /// Puts one empty line between groups; the base class puts two.
    std::string make_group(std::string group, bool is_positional,
                           std::vector<const CLI::Option*> options) const override
    {
        const std::string text = CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
        return is_positional ? text + "\n" : text.substr(1);
    }

    std::string make_option_name(const CLI::Option* option, bool is_positional) const override
    {
        if (is_positional || option->get_lnames().empty()) {
            return CLI::Formatter::make_option_name(option, is_positional);
        }
        return (option->get_snames().empty() ? "" : "-" + option->get_snames().front() + ", ") + nameOf(option);
    }

    std::string make_option_opts(const CLI::Option* option) const override
    {
        if (option->get_expected_max() == 0 || option->get_positional()) {
            return "";
        }
        // A long choice goes on in the next line.
        std::string type = " " + option->get_type_name();
        const std::size_t indent = 2 + make_option_name(option, false).size();
        if (indent + type.size() > kWidth) {
            const std::size_t bar = type.rfind('|', kWidth - indent - 1);
            type.insert(bar == std::string::npos ? type.size() : bar + 1, "\n" + std::string(indent + 1, ' '));
        }
        return type;
    }

private:
    std::string usage_;
};

}  // namespace

class CommandLine::Parser {
public:
    explicit Parser(const CommandText& text)
        : text_(text), app_("droplet-shape " + std::string(droplet::kVersion) + ": " + text.title)
    {
        app_.formatter(std::make_shared<HelpFormatter>(text));
        app_.set_help_flag();
        app_.allow_extras();
        app_.allow_windows_style_options(false);  // which would take the path /a for an option
        app_.footer(listOf(text.commands) + text.footer);
    }

    void add(const char* group, const char* names, const char* type, const std::string& description)
    {
        app_.add_option(names)->description(wrapped(description))->type_name(type)->group(group)->take_all();
        descriptions_[app_.get_options().back()] = description;
    }

    void add(const char* group, const char* names, const char* type, const std::string& description,
             OptionTarget target)
    {
        const bool has_own = described(description).usual.empty() && !target.usual.empty();
        add(group, names, type, has_own ? description + " [" + target.usual + "]" : description);
        targets_[app_.get_options().back()] = std::move(target);
    }

    void addFlag(const char* group, const char* names, const std::string& description, bool& value)
    {
        addFlag(group, names, description);
        targets_[app_.get_options().back()] = {[&value](const Given& given) { value = given.text == "true"; }};
    }

    void read() const
    {
        for (const CLI::Option* option : app_.get_options()) {
            const auto target = targets_.find(option);
            if (target != targets_.end() && target->second.read && option->count() > 0) {
                target->second.read(*value(nameOf(option)));
            }
        }
    }

    void addList(const char* group, const char* names, const char* type, const std::string& description)
    {
        add(group, names, type, description);
        lists_.insert(app_.get_options().back());
    }

    void addFlag(const char* group, const char* names, const std::string& description)
    {
        app_.add_flag(names)->description(wrapped(description))->group(group);
        descriptions_[app_.get_options().back()] = description;
    }

    void addArgument(const char* name, const std::string& description)
    {
        app_.add_option(name)->description(wrapped(description));
        descriptions_[app_.get_options().back()] = description;
        arguments_ += (arguments_.empty() ? "" : " and ") + std::string(name);
    }

    void addArguments(const char* name, const std::string& description)
    {
        // CLI11 needs a maximum, and demands the minimum number unless extra arguments are allowed.
        app_.add_option(name)->description(wrapped(description))->expected(0, 1 << 29)->allow_extra_args()->take_all();
        descriptions_[app_.get_options().back()] = description;
    }

    void exclude(const std::vector<std::string>& names) { exclusive_.push_back(names); }

    void moveWords(const char* from, std::vector<std::string> words, const char* to)
    {
        moved_.push_back({app_.get_option(from), std::move(words), app_.get_option(to)});
    }

    void parse(int argc, const char* const* argv)
    {
        refuseEmptyValues(argc, argv);
        try {
            app_.parse(argc, argv);
        } catch (const CLI::ArgumentMismatch& error) {
            const std::string message = error.what();
            refuse(message.substr(0, message.find(':')) + ": value is missing");
        } catch (const CLI::ParseError& error) {
            refuse(error.what());
        }
        refuseExtras();
        takeMovedWords();
        refuseRepetitions();
        if (!asksForText()) {
            if (const auto config = has("--config") ? value("--config") : std::nullopt) {
                addConfig(config->text);
            }
            dropStatedWords();
            refuseConflicts();
        }
    }

    [[nodiscard]] bool has(const std::string& name) const { return app_.get_option_no_throw(name) != nullptr; }

    [[nodiscard]] bool flag(const std::string& name) const
    {
        const CLI::Option* option = app_.get_option(name);
        return option->count() > 0 && option->results().back() == "true";
    }

    [[nodiscard]] std::optional<Given> value(const std::string& name) const
    {
        const CLI::Option* option = app_.get_option(name);
        if (option->count() == 0) {
            return std::nullopt;
        }
        const auto origin = origins_.find(name);
        return Given{option->results().back(), origin == origins_.end() ? name : name + origin->second};
    }

    [[nodiscard]] std::vector<Given> values(const std::string& name) const
    {
        const auto origin = origins_.find(name);
        std::vector<Given> all;
        for (const std::string& text : app_.get_option(name)->results()) {
            all.push_back({text, origin == origins_.end() ? name : name + origin->second});
        }
        return all;
    }

    [[nodiscard]] std::string argument(const std::string& name) const
    {
        const auto given = value(name);
        if (!given || given->text.empty()) {
            refuse(name + " is missing; usage: " + text_.name + " " + text_.usage + ", more with --help");
        }
        return given->text;
    }

    [[nodiscard]] std::vector<std::pair<std::string, std::string>> given() const
    {
        std::vector<std::pair<std::string, std::string>> all;
        for (const CLI::Option* option : app_.get_options()) {
            if (option->get_positional()) {
                continue;
            }
            const std::string name = nameOf(option);
            if (isFlag(option)) {
                if (flag(name)) {
                    all.emplace_back(name, "true");
                }
                continue;
            }
            for (const std::string& text : option->results()) {
                all.emplace_back(name, text);
            }
        }
        return all;
    }

    [[nodiscard]] CommandTerms terms() const
    {
        CommandTerms terms;
        for (const CLI::Option* option : app_.get_options()) {
            if (!option->get_positional()) {
                terms.options.push_back(nameOf(option));
            }
        }
        for (const auto& [name, value] : given()) {
            terms.given.push_back(name);
        }
        return terms;
    }

    /// `text`, `json`, or nothing without --help.
    [[nodiscard]] std::string helpForm() const
    {
        const CLI::Option* help = app_.get_option("--help");
        const std::string form = help->count() == 0 ? "false" : help->results().back();
        return form == "true" ? "text" : form == "false" ? "" : form;
    }

    [[nodiscard]] std::string help() const { return app_.help(); }

    [[nodiscard]] std::string helpJson() const
    {
        nlohmann::ordered_json json{{"schema", "droplet-shape.help/1"},
                                    {"version", droplet::kVersion},
                                    {"command", text_.name},
                                    {"title", text_.title},
                                    {"usage", text_.name + " " + text_.usage},
                                    {"arguments", nlohmann::ordered_json::array()},
                                    {"options", nlohmann::ordered_json::array()},
                                    {"exclusive", exclusive_},
                                    {"commands", nlohmann::ordered_json::array()},
                                    {"footer", text_.footer}};
        for (const CLI::Option* option : app_.get_options()) {
            if (option->get_positional()) {
                json["arguments"].push_back({{"name", option->get_name()}, {"text", descriptions_.at(option)}});
            } else {
                json["options"].push_back(jsonOf(option));
            }
        }
        for (const auto& [name, title] : text_.commands) {
            json["commands"].push_back({{"name", name}, {"title", title}});
        }
        return json.dump(2) + "\n";
    }

private:
    /// Whether --help or --version is given, so that other options do not matter.
    [[nodiscard]] bool asksForText() const
    {
        return (has("--help") && !helpForm().empty()) || (has("--version") && flag("--version"));
    }

    [[nodiscard]] nlohmann::ordered_json jsonOf(const CLI::Option* option) const
    {
        const Described description = described(descriptions_.at(option));
        const std::string value = isFlag(option) ? "" : option->get_type_name();
        const ValueKind kind = isFlag(option) ? ValueKind{"flag"} : valueKind(value).value_or(ValueKind{"unknown"});
        std::vector<std::string> words;
        std::istringstream parts(value.find('|') == std::string::npos ? "" : value);
        for (std::string part; std::getline(parts, part, '|');) {
            if (std::isupper(static_cast<unsigned char>(part.front())) == 0) {
                words.push_back(part);
            }
        }
        std::vector<std::string> former;
        for (std::size_t k = 1; k < option->get_lnames().size(); ++k) {
            former.push_back("--" + option->get_lnames()[k]);
        }
        const auto target = targets_.find(option);
        nlohmann::ordered_json min;
        nlohmann::ordered_json max;
        if (target != targets_.end() && target->second.range) {
            min = target->second.range->front();
            max = target->second.range->back();
        }
        return {{"name", nameOf(option)},
                {"short", option->get_snames().empty() ? "" : "-" + option->get_snames().front()},
                {"former", former},
                {"group", option->get_group()},
                {"value", value},
                {"kind", kind.kind},
                {"unit", kind.unit},
                {"words", words},
                {"several", isList(option)},
                {"min", min},
                {"max", max},
                {"default", description.usual},
                {"text", description.text}};
    }

    [[nodiscard]] bool isList(const CLI::Option* option) const { return lists_.count(option) > 0; }

    /// Refuses empty values: CLI11 reads `--width= in.png` as `--width in.png`.
    static void refuseEmptyValues(int argc, const char* const* argv)
    {
        for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
            const std::string_view argument = argv[i];
            if (argument.substr(0, 2) == "--" && argument.find('=') + 1 == argument.size()) {
                refuse(std::string(argument.substr(0, argument.size() - 1)) + ": value is empty");
            }
        }
    }

    /// The option that an unknown name probably means, by its meaning or its letters; empty if there is none.
    [[nodiscard]] std::string nearest(const std::string& unknown) const
    {
        for (const std::vector<std::string>& group : synonyms()) {
            const bool is_synonym = std::find(group.begin(), group.end(), unknown) != group.end();
            const auto known = std::find_if(group.begin(), group.end(), [&](const auto& name) { return has(name); });
            if (is_synonym && known != group.end()) {
                return *known;
            }
        }
        std::vector<std::string> names;
        for (const CLI::Option* option : app_.get_options()) {
            if (!option->get_lnames().empty()) {
                names.push_back(nameOf(option));
            }
        }
        return nearestName(unknown, names);
    }

    void refuseExtras() const
    {
        const auto extras = app_.remaining();
        const auto is_option = [](const std::string& e) { return e.size() > 1 && e.front() == '-' && e != "--"; };
        const auto option = std::find_if(extras.begin(), extras.end(), is_option);
        if (option != extras.end()) {
            const std::string name = option->substr(0, option->find('='));
            const std::string known = nearest(name);
            const bool is_output = name == "-o" || name == "--output";
            if (is_output && text_.usage.find(" OUTPUT") != std::string::npos) {
                refuse("unknown option " + name + ": OUTPUT needs no option, as in " + text_.name + " " + text_.usage);
            }
            refuse("unknown option " + name + (known.empty() ? "" : ", did you mean " + known + "?") +
                   (known.empty() ? "; " + text_.name + " --help lists all" : ""));
        }
        const auto argument = std::find_if(extras.begin(), extras.end(), [](const auto& e) { return e != "--"; });
        if (argument != extras.end()) {
            refuse("unexpected argument '" + *argument + "'" + (arguments_.empty() ? "" : " after " + arguments_));
        }
    }

    /// Option that takes a value: the given one, or the one that its words belong to.
    [[nodiscard]] CLI::Option* takerOf(CLI::Option* option, const std::string& text) const
    {
        for (const MovedWords& moved : moved_) {
            if (moved.from == option && std::find(moved.words.begin(), moved.words.end(), text) != moved.words.end()) {
                return moved.to;
            }
        }
        return option;
    }

    void takeMovedWords()
    {
        for (const MovedWords& moved : moved_) {
            const std::vector<std::string> texts = moved.from->results();
            moved.from->clear();
            for (const std::string& text : texts) {
                takerOf(moved.from, text)->add_result(text);
            }
        }
    }

    /// Drops values that are the word by which the help states a default, where the value is not a word: `[none]`.
    void dropStatedWords()
    {
        for (CLI::Option* option : app_.get_options()) {
            if (option->get_positional() || isFlag(option) || option->count() == 0) {
                continue;
            }
            const std::string usual = described(descriptions_.at(option)).usual;
            const auto kind = valueKind(option->get_type_name());
            const bool is_word = std::all_of(usual.begin(), usual.end(), [](char c) { return c >= 'a' && c <= 'z'; });
            const bool takes_words = !kind || kind->kind == "words" || kind->kind == "text" || kind->kind == "path";
            if (is_word && !takes_words && option->results().back() == usual) {
                option->clear();
            }
        }
    }

    void refuseRepetitions() const
    {
        for (const CLI::Option* option : app_.get_options()) {
            if (option->count() == 0 || option->get_positional()) {
                continue;
            }
            const std::string name = nameOf(option);
            if (isFlag(option)) {
                const Given given{option->results().back(), name};
                if (name == "--help" && given.text != "json" && given.text != "true" && given.text != "false") {
                    refuse(given, "true, false or json");
                } else if (name != "--help") {
                    requireBoolean(given);
                }
            } else if (option->count() > 1 && !isList(option)) {
                refuse(name + ": given " + std::to_string(option->count()) + " times, must be given once");
            }
        }
    }

    static bool isFlag(const CLI::Option* option) { return option->get_expected_max() == 0; }

    /// Refuses other values of a flag: CLI11 accepts any word in `--open=word`.
    static void requireBoolean(const Given& given)
    {
        if (given.text != "true" && given.text != "false") {
            refuse(given, "true or false");
        }
    }

    /// Whether the command line has this option, or one that excludes it, and so overrides the configuration file.
    [[nodiscard]] bool isOverridden(const std::string& name) const
    {
        const auto given = [&](const std::string& other) {
            return app_.get_option(other)->count() > 0 && origins_.find(other) == origins_.end();
        };
        for (const auto& group : exclusive_) {
            if (std::find(group.begin(), group.end(), name) != group.end() &&
                std::any_of(group.begin(), group.end(), given)) {
                return true;
            }
        }
        return given(name);
    }

    void addConfig(const std::string& path)
    {
        for (const ConfigEntry& entry : readConfig(path)) {
            const std::string origin = " (" + path + ":" + std::to_string(entry.line) + ")";
            CLI::Option* option = entry.key.size() > 1 ? app_.get_option_no_throw("--" + entry.key) : nullptr;
            option = option == nullptr ? nullptr : takerOf(option, entry.value);
            const std::string name = option == nullptr ? "--" + entry.key : nameOf(option);
            if (option == nullptr || name == "--config" || name == "--help" || name == "--version") {
                const std::string known = option == nullptr ? nearest(name) : "";
                refuse("--config: " + path + ":" + std::to_string(entry.line) + ": unknown key '" + entry.key + "'" +
                       (known.empty() ? "" : ", did you mean '" + known.substr(2) + "'?"));
            }
            if (isFlag(option)) {
                requireBoolean({entry.value, name + origin});
            }
            if (!isOverridden(name)) {
                if (option->count() > 0) {
                    refuse(
                        fmt::format("--config: {}:{}: '{}' gives {} a second time", path, entry.line, entry.key, name));
                }
                option->add_result(entry.value);
                origins_[name] = origin;
            }
        }
    }

    void refuseConflicts() const
    {
        for (const auto& group : exclusive_) {
            std::vector<std::string> given;
            for (const std::string& name : group) {
                if (isFlag(app_.get_option(name)) ? flag(name) : value(name).has_value()) {
                    given.push_back(name);
                }
            }
            if (given.size() > 1) {
                refuse(given[0] + " and " + given[1] + " exclude each other, give one of them");
            }
        }
    }

    /// Words that are values of another option than the one that they may be given to.
    struct MovedWords {
        CLI::Option* from;
        std::vector<std::string> words;
        CLI::Option* to;
    };

    CommandText text_;
    CLI::App app_;
    std::string arguments_;  ///< names of the arguments, for messages
    std::vector<std::vector<std::string>> exclusive_;
    std::vector<MovedWords> moved_;
    std::unordered_set<const CLI::Option*> lists_;
    std::unordered_map<const CLI::Option*, std::string> descriptions_;  ///< as declared
    std::unordered_map<const CLI::Option*, OptionTarget> targets_;
    std::unordered_map<std::string, std::string> origins_;  ///< places of options in the configuration file
};

CommandLine::CommandLine(const CommandText& text) : parser_(std::make_unique<Parser>(text)) {}

CommandLine::~CommandLine() = default;

void CommandLine::add(const char* group, const char* names, const char* type, const std::string& description)
{
    parser_->add(group, names, type, description);
}

void CommandLine::addList(const char* group, const char* names, const char* type, const std::string& description)
{
    parser_->addList(group, names, type, description);
}

void CommandLine::addFlag(const char* group, const char* names, const std::string& description)
{
    parser_->addFlag(group, names, description);
}

void CommandLine::add(const char* group, const char* names, const char* type, const std::string& description,
                      OptionTarget target)
{
    parser_->add(group, names, type, description, std::move(target));
}

void CommandLine::add(const char* group, const char* names, const std::string& description, OptionTarget target)
{
    const std::string type = target.words;
    parser_->add(group, names, type.c_str(), description, std::move(target));
}

void CommandLine::addFlag(const char* group, const char* names, const std::string& description, bool& value)
{
    parser_->addFlag(group, names, description, value);
}

void CommandLine::read() const
{
    parser_->read();
}

void CommandLine::addArgument(const char* name, const std::string& description)
{
    parser_->addArgument(name, description);
}

void CommandLine::addArguments(const char* name, const std::string& description)
{
    parser_->addArguments(name, description);
}

void CommandLine::exclude(const std::vector<std::string>& names)
{
    parser_->exclude(names);
}

void CommandLine::moveWords(const char* from, const std::vector<std::string>& words, const char* to)
{
    parser_->moveWords(from, words, to);
}

void CommandLine::parse(int argc, const char* const* argv)
{
    parser_->parse(argc, argv);
}

bool CommandLine::knows(const std::string& name) const
{
    return parser_->has(name);
}

bool CommandLine::flag(const std::string& name) const
{
    return parser_->flag(name);
}

std::optional<Given> CommandLine::value(const std::string& name) const
{
    return parser_->value(name);
}

std::vector<Given> CommandLine::values(const std::string& name) const
{
    return parser_->values(name);
}

std::string CommandLine::argument(const std::string& name) const
{
    return parser_->argument(name);
}

std::vector<std::pair<std::string, std::string>> CommandLine::given() const
{
    return parser_->given();
}

CommandTerms CommandLine::terms() const
{
    return parser_->terms();
}

std::string CommandLine::help() const
{
    return parser_->help();
}

std::string CommandLine::helpJson() const
{
    return parser_->helpJson();
}

std::optional<std::string> CommandLine::requestedHelp() const
{
    const std::string form = parser_->helpForm();
    if (form.empty()) {
        return std::nullopt;
    }
    return form == "json" ? helpJson() : help();
}

}  // namespace cli
