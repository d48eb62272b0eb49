// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/svg/drawing_tree.h"

#include <libxml/parser.h>

#include <algorithm>

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
