// SPDX-License-Identifier: GPL-3.0-or-later
// Prints height, pressure and contact angle of a droplet over its volume, as CSV: sweep IN.png
// It calls the stages one by one, so the picture is traced and triangulated only once.
#include <droplet/domain/domain.h>
#include <droplet/error.h>
#include <droplet/mask/mask.h>
#include <droplet/mesh/triangulate.h>
#include <droplet/outline/outline.h>
#include <droplet/shape/figures.h>
#include <droplet/shape/solve.h>

#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: sweep IN.png\n";
        return 2;
    }
    try {
        const droplet::Domain domain = droplet::split(droplet::trace(droplet::readMask(argv[1])));
        const std::vector<droplet::PlanarMesh> meshes = droplet::triangulate(domain, {.triangles = 5000});
        droplet::SolveOptions options;
        options.fill.by = droplet::FillBy::Volume;
        options.fill.sharing = droplet::FillSharing::Total;  // one volume for all droplets together
        std::cout << "volume_ul,height_mm,pressure_pa,contact_angle_deg\n";
        for (double volume = 10e-9; volume < 55e-9; volume += 10e-9) {  // 10 to 50 uL, in cubic metres
            options.fill.amount = volume;
            const droplet::Solution solution = droplet::solve(meshes, options);
            std::vector<droplet::ShapeFigures> each;
            for (std::size_t k = 0; k < meshes.size(); ++k) {
                each.push_back(droplet::measure(solution.droplets[k], options));
            }
            const droplet::ShapeFigures figures = droplet::combine(each);
            std::cout << volume * 1e9 << "," << figures.height_max * 1e3 << "," << solution.droplets[0].pressure << ","
                      << figures.contact_angle.mean * 57.29578 << "\n";
        }
    } catch (const droplet::Error& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
