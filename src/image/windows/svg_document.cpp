// SPDX-License-Identifier: GPL-3.0-or-later
// After: Scalable Vector Graphics 2 (W3C), 8.2 and 8.12 (the size of a page); CSS Values and Units 3, 5.2; CSS Fonts
// 4, 2.7.
#include "image/windows/svg_document.h"

#include <fmt/core.h>
#include <libxml/tree.h>
#include <libxml/xmlerror.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "droplet/units.h"
#include "image/image_bytes.h"
#include "image/svg/css_text.h"
#include "image/svg/drawing_tree.h"
#include "image/svg/style_sheet.h"

namespace droplet {
namespace {

constexpr double kInch = 25.4 * kMillimetre;
constexpr double kDotsPerInch = 96.0;  // CSS

std::string problemOf(const xmlError* error)
{
    if (error == nullptr || error->message == nullptr) {
        return "it is not an SVG drawing";
    }
    return fmt::format("XML parse error: on line {} column {} of data: {}", error->line, error->int2,
                       trimmed(error->message));
}

/// Length that depends on nothing else.
struct Length {
    double pixels = 0.0;
    std::optional<double> metres;  ///< of a physical unit
};

std::optional<Length> lengthOf(const xmlNode& element, const char* name)
{
    const auto attribute = attributeOf(element, name);
    const auto pixels = attribute ? parsePixels(trimmed(*attribute)) : std::nullopt;
    if (!pixels) {
        return std::nullopt;
    }
    const std::string text = lowered(trimmed(*attribute));
    constexpr std::array<std::string_view, 6> kPhysical{"in", "cm", "mm", "q", "pt", "pc"};
    const bool is_physical =
        std::any_of(kPhysical.begin(), kPhysical.end(), [&](std::string_view unit) { return text.ends_with(unit); });
    return Length{*pixels, is_physical ? std::optional(*pixels / kDotsPerInch * kInch) : std::nullopt};
}

bool isSize(std::string_view word)
{
    constexpr std::array<std::string_view, 9> kSizes{"xx-small", "x-small",  "small",   "medium", "large",
                                                     "x-large",  "xx-large", "smaller", "larger"};
    return std::find(kSizes.begin(), kSizes.end(), word) != kSizes.end() || parseQuantity(word).has_value();
}

/// Declarations for which `font` stands: style and weight, size with the height of lines, families.
std::vector<Declaration> partsOfFont(const Declaration& font)
{
    std::vector<Declaration> parts;
    const auto add = [&](const char* name, std::string_view value) {
        parts.push_back({name, std::string(value), font.important});
    };
    std::string_view rest = trimmed(font.value);
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find_first_of(" \t\r\n"), rest.size());
        const std::string_view word = rest.substr(0, end);
        rest = trimmed(rest.substr(end));
        const std::string lower = lowered(word);
        constexpr std::string_view kWeights = "123456789";
        if (lower == "italic" || lower == "oblique") {
            add("font-style", lower);
        } else if (lower == "bold" || lower == "bolder" || lower == "lighter" ||
                   (lower.size() == 3 && lower.ends_with("00") && kWeights.find(lower[0]) != std::string_view::npos)) {
            add("font-weight", lower);
        } else if (const std::string_view size = std::string_view(lower).substr(0, lower.find('/')); isSize(size)) {
            if (rest.starts_with('/')) {  // the height of lines
                rest = trimmed(rest.substr(1));
                rest = trimmed(rest.substr(std::min(rest.find_first_of(" \t\r\n"), rest.size())));
            }
            add("font-size", size);
            add("font-family", rest);
            return parts;
        }
    }
    return {};
}

}  // namespace

struct SvgDocument::Tree {
    DrawingTree document;
    std::vector<xmlNode*> elements = {};  ///< in the order of the text

    [[nodiscard]] xmlNode& root() const { return *elements.front(); }

    void collect(xmlNode* first)
    {
        for (xmlNode* node = first; node != nullptr; node = node->next) {
            if (node->type == XML_ELEMENT_NODE) {
                elements.push_back(node);
                collect(node->children);
            }
        }
    }
};

SvgDocument::SvgDocument(std::span<const std::byte> text) : tree_(new Tree{parseDrawing(text)})
{
    xmlNode* const root = tree_->document ? xmlDocGetRootElement(tree_->document.get()) : nullptr;
    if (root == nullptr || nameOf(*root) != "svg") {
        throwDamaged(ImageFormat::Svg, problemOf(xmlGetLastError()));
    }
    tree_->collect(root);
    const StyleSheets styles(*root);
    for (xmlNode* const element : tree_->elements) {
        const auto font = styles.own(*element, "font");
        if (!font || font->is_attribute) {
            continue;
        }
        std::string style;
        const auto write = [&](const Declaration& declaration) {
            style += declaration.name + ":" + declaration.value + (declaration.important ? "!important;" : ";");
        };
        bool is_own = false;
        for (const Declaration& declaration : parseDeclarations(attributeOf(*element, "style").value_or(""))) {
            if (declaration.name == "font") {
                is_own = true;
                for (const Declaration& part : partsOfFont(declaration)) {
                    write(part);
                }
            } else {
                write(declaration);
            }
        }
        if (!is_own) {  // of a rule: what the style attribute has itself wins
            const std::string own = std::move(style);
            style.clear();
            for (const Declaration& part : partsOfFont({"font", font->value, false})) {
                if (!styles.own(*element, part.name)) {
                    write(part);
                }
            }
            style += own;
        }
        setAttribute(*element, "style", style);
    }
}

SvgDocument::~SvgDocument() = default;

std::string SvgDocument::text() const
{
    return textOf(tree_->document.get());
}

std::optional<SvgDocument::Page> SvgDocument::page(const std::function<std::optional<Resvg::Box>()>& ink)
{
    xmlNode& root = tree_->root();
    const auto sized = [&](const Page& page) {
        setAttribute(root, "width", fmt::format("{:.17g}", page.width));
        setAttribute(root, "height", fmt::format("{:.17g}", page.height));
        return page;
    };
    const auto width = lengthOf(root, "width");
    const auto height = lengthOf(root, "height");
    if (width && height) {
        return sized({width->pixels, height->pixels, width->metres});
    }
    std::vector<double> box;
    if (const auto attribute = attributeOf(root, "viewBox")) {
        for (const std::string_view part : partsOf(*attribute, ',')) {
            box.push_back(parsePixels(part).value_or(0.0));
        }
    }
    if (box.size() == 4 && box[2] > 0.0 && box[3] > 0.0) {
        // Either size may be given; missing ones follow from the box.
        const double aspect = box[2] / box[3];
        Page page;
        page.width = width ? width->pixels : height ? height->pixels * aspect : box[2];
        page.height = page.width / aspect;
        page.physical_width = width ? width->metres : std::nullopt;
        if (!width && height && height->metres) {
            page.physical_width = *height->metres * aspect;
        }
        return sized(page);
    }
    const auto drawn = ink();
    if (!drawn || !(drawn->width > 0.0 && drawn->height > 0.0)) {
        return std::nullopt;
    }
    setAttribute(root, "viewBox",
                 fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}", drawn->x, drawn->y, drawn->width, drawn->height));
    return sized({drawn->width, drawn->height, std::nullopt});
}

std::set<std::vector<std::string>> SvgDocument::families() const
{
    const StyleSheets styles(tree_->root());
    std::set<std::vector<std::string>> families;
    for (const xmlNode* const element : tree_->elements) {
        const std::string_view name = nameOf(*element);
        if (name != "text" && name != "tspan" && name != "textPath") {
            continue;
        }
        const auto value = styles.inherited(*element, "font-family");
        families.insert(familiesIn(value ? std::string_view(value->value) : "serif"));
    }
    return families;
}

std::vector<std::string> SvgDocument::lacking() const
{
    std::vector<std::string> lacking;
    const auto note = [&](const char* what) {
        if (std::find(lacking.begin(), lacking.end(), what) == lacking.end()) {
            lacking.emplace_back(what);
        }
    };
    for (const xmlNode* const element : tree_->elements) {
        const std::string_view name = nameOf(*element);
        if (name == "foreignObject") {
            note("foreignObject");
        } else if (name == "animate" || name == "animateTransform" || name == "animateMotion" || name == "set") {
            note("animations");
        } else if ((name == "image" || name == "feImage") && refersOutside(*element)) {
            note("linked pictures (embed them)");
        } else if (name == "use" && refersOutside(*element)) {
            note("linked drawings (embed them)");
        }
    }
    if (StyleSheets(tree_->root()).atRules().contains("@import")) {
        note("imported style sheets");
    }
    for (const xmlNode* node = tree_->document->children; node != nullptr; node = node->next) {
        if (node->type == XML_PI_NODE &&
            std::strcmp(reinterpret_cast<const char*>(node->name), "xml-stylesheet") == 0) {
            note("linked style sheets");
        }
    }
    return lacking;
}

}  // namespace droplet
