// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/svg/drawing_tree.h"

#include <libxml/parser.h>

#include <algorithm>
#include <cstring>

#include "image/svg/css_text.h"
#include "image/svg/style_sheet.h"

namespace droplet {
namespace {

xmlParserInput* loadNothing(const char* /*url*/, const char* /*id*/, xmlParserCtxt* /*context*/)
{
    return nullptr;
}

}  // namespace

DrawingTree parseDrawing(std::span<const std::byte> text)
{
    xmlSetExternalEntityLoader(loadNothing);
    return {xmlReadMemory(reinterpret_cast<const char*>(text.data()), static_cast<int>(text.size()), nullptr, nullptr,
                          XML_PARSE_NOENT | XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING),
            xmlFreeDoc};
}

std::string textOf(xmlDoc* document)
{
    xmlChar* bytes = nullptr;
    int size = 0;
    xmlDocDumpMemoryEnc(document, &bytes, &size, "UTF-8");
    std::string text(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(std::max(size, 0)));
    xmlFree(bytes);
    return text;
}

void setAttribute(xmlNode& element, const char* name, const std::string& value)
{
    xmlSetProp(&element, reinterpret_cast<const xmlChar*>(name), reinterpret_cast<const xmlChar*>(value.c_str()));
}

bool isDrawn(const xmlNode& element)
{
    return element.ns == nullptr ||
           std::strcmp(reinterpret_cast<const char*>(element.ns->href), "http://www.w3.org/2000/svg") == 0;
}

xmlNode* firstElement(xmlNode& root, const std::function<bool(const xmlNode&)>& is_wanted)
{
    std::vector<xmlNode*> open{&root};
    while (!open.empty()) {
        xmlNode* const element = open.back();
        open.pop_back();
        if (is_wanted(*element)) {
            return element;
        }
        for (xmlNode* child = element->last; child != nullptr; child = child->prev) {
            if (isElement(child)) {
                open.push_back(child);
            }
        }
    }
    return nullptr;
}

xmlNode* elementOf(xmlNode& root, std::string_view id)
{
    return firstElement(root, [&](const xmlNode& element) { return attributeOf(element, "id") == id; });
}

std::optional<SvgBox> viewBoxOf(const xmlNode& element)
{
    const auto attribute = attributeOf(element, "viewBox");
    std::vector<double> numbers;
    for (const std::string_view part : attribute ? partsOf(*attribute, ',') : std::vector<std::string_view>{}) {
        numbers.push_back(parsePixels(part).value_or(0.0));
    }
    return numbers.size() == 4 && numbers[2] > 0.0 && numbers[3] > 0.0
               ? std::optional(SvgBox{numbers[0], numbers[1], numbers[2], numbers[3]})
               : std::nullopt;
}

std::optional<double> pixelsOf(const xmlNode& element, const char* name)
{
    const auto attribute = attributeOf(element, name);
    return attribute ? parsePixels(*attribute) : std::nullopt;
}

std::optional<Matrix> viewportScale(const xmlNode& element)
{
    const auto box = viewBoxOf(element);
    if (!box) {
        return Matrix{};
    }
    const auto width = pixelsOf(element, "width");
    const auto height = pixelsOf(element, "height");
    if (!width && !height && isElement(element.parent)) {
        return std::nullopt;
    }
    double x = width ? *width / box->width : height ? *height / box->height : 1.0;
    double y = height ? *height / box->height : x;
    const std::string aspect = attributeOf(element, "preserveAspectRatio").value_or("");
    if (!aspect.starts_with("none")) {
        x = y = aspect.find("slice") == std::string::npos ? std::min(x, y) : std::max(x, y);
    }
    return Matrix{x, 0.0, 0.0, y, 0.0, 0.0};
}

bool refersOutside(const xmlNode& element)
{
    const std::string target(trimmed(attributeOf(element, "href").value_or("")));
    return !target.empty() && target.front() != '#' && !lowered(target.substr(0, 5)).starts_with("data:");
}

std::vector<std::string> familiesIn(std::string_view value)
{
    std::vector<std::string> families;
    for (std::string_view rest = value; !rest.empty();) {
        const std::size_t comma = rest.find(',');
        std::string_view family = trimmed(rest.substr(0, comma));
        rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
        if (family.size() >= 2 && (family.front() == '"' || family.front() == '\'')) {
            family = family.substr(1, family.size() - 2);
        }
        if (!family.empty()) {
            families.emplace_back(family);
        }
    }
    return families;
}

}  // namespace droplet
