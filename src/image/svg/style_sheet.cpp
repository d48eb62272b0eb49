// SPDX-License-Identifier: GPL-3.0-or-later
// After: CSS Syntax 3, Selectors 3 and CSS Cascading 4 (W3C), as far as drawings use them: types, classes, ids,
// descendants and children. Rules with other selectors are left to librsvg.
#include "image/svg/style_sheet.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

#include "image/svg/css_text.h"

namespace droplet {
namespace {

std::string withoutComments(std::string_view text)
{
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = text.find("/*", at);
        result += text.substr(at, begin == std::string_view::npos ? begin : begin - at);
        const std::size_t end = begin == std::string_view::npos ? begin : text.find("*/", begin + 2);
        at = end == std::string_view::npos ? text.size() : end + 2;
    }
    for (const std::string_view mark : {"<!--", "-->"}) {
        for (std::size_t at = result.find(mark); at != std::string::npos; at = result.find(mark)) {
            result.erase(at, mark.size());
        }
    }
    return result;
}

bool isName(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
}

/// Parts of a selector; none if it has others than types, classes, ids and :root.
std::optional<Compound> compoundOf(std::string_view text)
{
    Compound compound;
    for (std::size_t at = 0; at < text.size();) {
        const char mark = text[at];
        at += mark == '.' || mark == '#' || mark == ':' || mark == '*' ? 1 : 0;
        std::size_t end = at;
        while (end < text.size() && isName(text[end])) {
            ++end;
        }
        const std::string name(text.substr(at, end - at));
        if (name.empty() != (mark == '*')) {
            return std::nullopt;
        }
        if (mark == '.') {
            compound.classes.push_back(name);
        } else if (mark == '#') {
            compound.id = name;
        } else if (mark == ':' && name == "root") {
            compound.is_root = true;
        } else if (mark == ':') {
            return std::nullopt;
        } else if (mark != '*') {
            compound.type = name;
        }
        at = end;
    }
    return compound;
}

bool hasClass(const xmlNode& element, const std::string& name)
{
    const auto classes = attributeOf(element, "class");
    if (!classes) {
        return false;
    }
    const std::vector<std::string_view> all = partsOf(*classes, ',');
    return std::find(all.begin(), all.end(), name) != all.end();
}

bool matches(const xmlNode& element, const Compound& compound)
{
    return (compound.type.empty() || nameOf(element) == compound.type) &&
           (compound.id.empty() || attributeOf(element, "id") == compound.id) &&
           (!compound.is_root || !isElement(element.parent)) &&
           std::all_of(compound.classes.begin(), compound.classes.end(),
                       [&](const std::string& name) { return hasClass(element, name); });
}

/// Whether an element and its ancestors match the first `count` parts of a selector.
bool matches(const xmlNode& element, const std::vector<Compound>& selector, std::size_t count)
{
    const Compound& last = selector[count - 1];
    if (!matches(element, last)) {
        return false;
    }
    if (count == 1) {
        return true;
    }
    for (const xmlNode* above = element.parent; isElement(above); above = above->parent) {
        if (matches(*above, selector, count - 1)) {
            return true;
        }
        if (last.is_child) {
            return false;
        }
    }
    return false;
}

void addStyles(const xmlNode& node, std::string& sheets)
{
    if (nameOf(node) == "style") {
        xmlChar* const content = xmlNodeGetContent(&node);
        sheets += content == nullptr ? "" : reinterpret_cast<const char*>(content);
        sheets += '\n';
        xmlFree(content);
        return;
    }
    for (const xmlNode* child = node.children; child != nullptr; child = child->next) {
        if (isElement(child)) {
            addStyles(*child, sheets);
        }
    }
}

}  // namespace

bool isElement(const xmlNode* node)
{
    return node != nullptr && node->type == XML_ELEMENT_NODE;
}

std::optional<std::string> attributeOf(const xmlNode& element, const char* name)
{
    for (const xmlAttr* attribute = element.properties; attribute != nullptr; attribute = attribute->next) {
        if (std::strcmp(reinterpret_cast<const char*>(attribute->name), name) == 0) {
            xmlChar* const value = xmlNodeListGetString(element.doc, attribute->children, 1);
            std::string text = value == nullptr ? "" : reinterpret_cast<const char*>(value);
            xmlFree(value);
            return text;
        }
    }
    return std::nullopt;
}

std::string_view nameOf(const xmlNode& element)
{
    return reinterpret_cast<const char*>(element.name);
}

std::vector<Declaration> parseDeclarations(std::string_view text)
{
    std::vector<Declaration> declarations;
    for (const std::string_view part : partsOf(text, ';')) {
        const std::size_t colon = part.find(':');
        if (colon == std::string_view::npos) {
            continue;
        }
        const std::string_view name = trimmed(part.substr(0, colon));
        std::string_view value = trimmed(part.substr(colon + 1));
        const std::size_t mark = value.rfind('!');
        const bool important =
            mark != std::string_view::npos && lowered(trimmed(value.substr(mark + 1))) == "important";
        value = important ? trimmed(value.substr(0, mark)) : value;
        declarations.push_back(
            {name.starts_with("--") ? std::string(name) : lowered(name), std::string(value), important});
    }
    return declarations;
}

StyleSheets::StyleSheets(const xmlNode& root)
{
    std::string sheets;
    addStyles(root, sheets);
    read(withoutComments(sheets));
}

void StyleSheets::read(std::string_view sheet)
{
    while (!(sheet = trimmed(sheet)).empty()) {
        const std::size_t stop = sheet.find_first_of("{;");
        if (stop == std::string_view::npos) {
            return;
        }
        const std::string_view head = trimmed(sheet.substr(0, stop));
        const std::size_t end = sheet[stop] == ';' ? stop + 1 : closingOf(sheet, stop).value_or(sheet.size());
        if (head.starts_with('@')) {
            at_rules_.insert(lowered(head.substr(0, head.find_first_of(" \t\r\n\"'("))));
        } else if (sheet[stop] == '{') {
            addRule(head, sheet.substr(stop + 1, end - stop - 2));
        }
        sheet.remove_prefix(end);
    }
}

void StyleSheets::addRule(std::string_view selectors, std::string_view declarations)
{
    const std::vector<Declaration> all = parseDeclarations(declarations);
    for (std::string_view rest = selectors; !rest.empty();) {
        const std::size_t comma = rest.find(',');
        std::string selector(trimmed(rest.substr(0, comma)));
        rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
        StyleRule rule{{}, 0, all};
        bool is_child = false;
        bool is_known = !selector.empty();
        for (std::size_t at = selector.find('>'); at != std::string::npos; at = selector.find('>', at + 3)) {
            selector.replace(at, 1, " > ");
        }
        for (const std::string_view part : partsOf(selector, ',')) {
            if (part == ">") {
                is_child = true;
                continue;
            }
            auto compound = compoundOf(part);
            if (!compound) {
                is_known = false;
                break;
            }
            compound->is_child = std::exchange(is_child, false);
            rule.specificity +=
                (compound->id.empty() ? 0U : 1U << 20) +
                (static_cast<unsigned>(compound->classes.size()) + (compound->is_root ? 1U : 0U)) * (1U << 10) +
                (compound->type.empty() ? 0U : 1U);
            rule.selector.push_back(std::move(*compound));
        }
        if (is_known && !rule.selector.empty()) {
            rules_.push_back(std::move(rule));
        }
    }
}

std::optional<StyleValue> StyleSheets::own(const xmlNode& element, const std::string& name) const
{
    std::optional<StyleValue> best;
    std::tuple<bool, bool, unsigned> rank;  // important, style attribute, specificity
    const auto consider = [&](const Declaration& declaration, bool is_inline, unsigned specificity) {
        const std::tuple here{declaration.important, is_inline, specificity};
        if (declaration.name == name && (!best || here >= rank)) {
            best = StyleValue{declaration.value, false};
            rank = here;
        }
    };
    for (const StyleRule& rule : rules_) {
        const bool has_it = std::any_of(rule.declarations.begin(), rule.declarations.end(),
                                        [&](const Declaration& each) { return each.name == name; });
        if (has_it && matches(element, rule.selector, rule.selector.size())) {
            for (const Declaration& declaration : rule.declarations) {
                consider(declaration, false, rule.specificity);
            }
        }
    }
    if (const auto style = attributeOf(element, "style")) {
        for (const Declaration& declaration : parseDeclarations(*style)) {
            consider(declaration, true, 0);
        }
    }
    if (!best) {
        if (auto attribute = attributeOf(element, name.c_str())) {
            best = StyleValue{std::move(*attribute), true};
        }
    }
    return best;
}

std::optional<StyleValue> StyleSheets::inherited(const xmlNode& element, const std::string& name) const
{
    for (const xmlNode* here = &element; isElement(here); here = here->parent) {
        auto value = own(*here, name);
        if (value && lowered(trimmed(value->value)) != "inherit") {
            return value;
        }
    }
    return std::nullopt;
}

}  // namespace droplet
