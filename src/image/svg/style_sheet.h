// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <libxml/tree.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace droplet {

/// Property and its value.
struct Declaration {
    std::string name;
    std::string value;
    bool important = false;
};

/// Declarations of a style attribute or a rule.
std::vector<Declaration> parseDeclarations(std::string_view text);

/// Part of a selector: what one element must be.
struct Compound {
    std::string type;  ///< local name; empty: any
    std::string id;    ///< empty: any
    std::vector<std::string> classes;
    bool is_root = false;
    bool is_child = false;  ///< whether the part before it must be the parent, not any ancestor
};

/// Rule of a style sheet with one selector.
struct StyleRule {
    std::vector<Compound> selector;  ///< the outermost element first
    unsigned specificity = 0;
    std::vector<Declaration> declarations;
};

/// Where the value of a property comes from.
struct StyleValue {
    std::string value;
    bool is_attribute = false;  ///< a presentation attribute; else a rule or the style attribute
};

/// Whether a node is an element; null is none.
bool isElement(const xmlNode* node);
/// Name of an attribute, or none.
std::optional<std::string> attributeOf(const xmlNode& element, const char* name);
/// Local name of an element.
std::string_view nameOf(const xmlNode& element);

/// Style sheets of a document: what each element's properties are by the cascade.
class StyleSheets {
public:
    /// Reads all style elements.
    explicit StyleSheets(const xmlNode& root);

    /// Winning declaration of a property for an element, without inheritance.
    [[nodiscard]] std::optional<StyleValue> own(const xmlNode& element, const std::string& name) const;
    /// The same, or that of the nearest ancestor that has one.
    [[nodiscard]] std::optional<StyleValue> inherited(const xmlNode& element, const std::string& name) const;

    /// Rules that import other sheets or declare fonts, such as `@import`.
    [[nodiscard]] const std::set<std::string>& atRules() const { return at_rules_; }
    /// All rules.
    [[nodiscard]] const std::vector<StyleRule>& rules() const { return rules_; }

private:
    void read(std::string_view sheet);
    void addRule(std::string_view selectors, std::string_view declarations);

    std::vector<StyleRule> rules_;
    std::set<std::string> at_rules_;
};

}  // namespace droplet
