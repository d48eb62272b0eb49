// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/open_edges.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>

namespace droplet {

std::vector<Triangle> weldedTriangles(std::vector<Triangle> triangles, const std::vector<std::uint32_t>& weld)
{
    for (Triangle& triangle : triangles) {
        for (std::uint32_t& v : triangle) {
            v = weld[v];
        }
    }
    return triangles;
}

std::vector<DirectedEdge> openEdges(const std::vector<Triangle>& triangles)
{
    std::vector<DirectedEdge> edges;
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.push_back({t[k], t[(k + 1) % 3]});
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<DirectedEdge> open;
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(open), [&](const DirectedEdge& edge) {
        return !std::binary_search(edges.begin(), edges.end(), DirectedEdge{edge[1], edge[0]});
    });
    return open;
}

std::vector<std::vector<std::uint32_t>> loopsOf(const std::vector<DirectedEdge>& edges)
{
    std::multimap<std::uint32_t, std::uint32_t> next;
    for (const auto& [from, to] : edges) {
        next.emplace(to, from);
    }
    std::vector<std::vector<std::uint32_t>> loops;
    while (!next.empty()) {
        std::vector<std::uint32_t> loop{next.begin()->first};
        for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
            const std::uint32_t to = at->second;
            next.erase(at);
            // Loops that touch in a vertex are several.
            if (const auto met = std::find(loop.begin(), loop.end(), to); met != loop.end()) {
                loops.emplace_back(met, loop.end());
                loop.erase(met + 1, loop.end());
                if (loop.size() == 1) {
                    break;
                }
            } else {
                loop.push_back(to);
            }
        }
    }
    return loops;
}

}  // namespace droplet
