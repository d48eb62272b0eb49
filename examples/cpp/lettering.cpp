// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a droplet of a text: lettering FONT.ttf TEXT OUT.glb
#include <droplet/droplet.h>
#include <droplet/error.h>
#include <droplet/io/output.h>
#include <droplet/type/font.h>
#include <droplet/type/glyph.h>

#include <iostream>

int main(int argc, char** argv)
{
    if (argc != 4) {
        std::cerr << "usage: lettering FONT.ttf TEXT OUT.glb\n";
        return 2;
    }
    try {
        droplet::TextOptions type;
        type.glyph.em = 30e-3;  // type size: 3 cm
        droplet::TextLayout text = droplet::layOutText(droplet::readFont(argv[1]), argv[2], type);
        if (!text.missing.empty()) {
            std::cerr << text.missing.size() << " characters are not in the font\n";
        }
        const droplet::Droplet drop = droplet::makeDroplet(std::move(text.outline));
        droplet::WriteOptions look;
        look.material = droplet::Material::Ink;
        droplet::writeAtomically(
            argv[3], [&](std::ostream& out) { writeSurface(drop.surface, out, droplet::Format::Glb, look); });
    } catch (const droplet::Error& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
