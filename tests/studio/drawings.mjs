// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings that Studio and the command must draw alike: a name, and what stands in a page of 100 × 100.

const kBar = '<rect x="40" y="20" width="20" height="60"';

export const kDrawings = {
    'transform-origin in px': `${kBar} style="transform:rotate(90deg);transform-origin:50px 50px"/>`,
    'transform-origin as an attribute': `${kBar} transform="rotate(30)" transform-origin="50 50"/>`,
    'transform-origin in percent': `${kBar} style="transform:rotate(45deg);transform-origin:50% 50%"/>`,
    'transform-origin by keywords': `${kBar} style="transform:scale(.5);transform-origin:right bottom"/>`,
    'transform-origin in a rule': `<style>.turned{transform:skewX(20deg);transform-origin:50px 80px}</style>${kBar} class="turned"/>`,
    'transform-box fill-box': `${kBar} style="transform:rotate(90deg);transform-origin:center;transform-box:fill-box"/>`,
    'transform-box of a group': '<g style="transform:scale(.5);transform-origin:0 100%;transform-box:fill-box"><circle cx="40" cy="40" r="20"/><rect x="50" y="50" width="30" height="10"/></g>',
    'transform-box in a turned group': `<g transform="rotate(10 50 50)">${kBar} style="transform:rotate(45deg);transform-origin:100% 50%;transform-box:fill-box"/></g>`,
    'transform-box without an origin': `${kBar} style="transform:rotate(20deg);transform-box:fill-box"/>`,
    'rotate as a property': `${kBar} style="rotate:60deg;transform-origin:50px 50px"/>`,
    'translate, rotate and scale as properties': `${kBar} style="translate:10px -5px;rotate:90deg;scale:.8;transform-origin:50px 50px"/>`,
    'a style before an attribute': `${kBar} transform="translate(30 0)" style="transform:translate(-20px,10px)"/>`,
    'a variable with a fallback': '<g fill="none"><circle cx="50" cy="50" r="30" fill="var(--fill-0, #1e1e1e)"/></g>',
    'a variable of the root': '<style>:root{--width:8;--ink:#000}</style><path d="M10 50H90" style="stroke:var(--ink);stroke-width:var(--width)"/>',
    'a variable that is inherited': '<g style="--wide:20px"><g><path d="M10 50H90" stroke="black" style="stroke-width:calc(var(--wide) / 2)"/></g></g>',
    'a fallback in a fallback': '<circle cx="50" cy="50" r="20" style="fill:none;stroke:var(--a, var(--b, black));stroke-width:6"/>',
    'calc in a style': '<circle cx="50" cy="50" style="r:calc(20px + (10px / 2))"/>',
    'min, max and clamp': '<rect x="10" y="10" style="width:min(80px, 50px);height:clamp(10px, 2mm * 5, 60px)"/>',
    'clip-path circle': '<rect width="100" height="100" style="clip-path:circle(30px at 50px 50px)"/>',
    'clip-path circle in percent': '<rect x="20" y="10" width="60" height="80" style="clip-path:circle(50% at 30% 60%)"/>',
    'clip-path ellipse': '<rect x="10" y="10" width="80" height="80" style="clip-path:ellipse(40px 20px at 50% 50%)"/>',
    'clip-path inset': '<rect x="10" y="10" width="80" height="80" style="clip-path:inset(10px 20px 5% 0 round 12px)"/>',
    'clip-path polygon': '<circle cx="50" cy="50" r="40" style="clip-path:polygon(50% 0, 100% 100%, 0 100%)"/>',
    'clip-path polygon with holes': '<rect width="100" height="100" style="clip-path:polygon(evenodd, 0 0, 100px 0, 100px 100px, 0 100px, 0 0, 30px 30px, 70px 30px, 70px 70px, 30px 70px, 30px 30px)"/>',
    'clip-path path': '<rect width="100" height="100" style="clip-path:path(\'M10 10H90V60H10z\')"/>',
    'clip-path in a view box': '<rect x="20" y="20" width="60" height="60" style="clip-path:circle(40px at 50px 50px) view-box"/>',
    'clip-path of a turned shape': '<g transform="translate(20 0)"><rect x="20" y="20" width="60" height="40" transform="rotate(15)" style="clip-path:inset(5px 10px) fill-box"/></g>',
    'strokes that do not scale': '<g transform="scale(10)"><path d="M2 2L8 8" stroke="black" stroke-width="4" vector-effect="non-scaling-stroke"/></g>',
    'turned strokes that do not scale': '<g stroke="black" stroke-width="6" stroke-dasharray="12 8" fill="none" transform="rotate(30) scale(.25)"><path d="M40 -20H300" style="vector-effect:non-scaling-stroke"/></g>',
    'a path in a style': '<path style="d:path(\'M20 20H80V50z\')"/>',
};

/** A drawing as a file. */
export const fileOf = (name) => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100" width="100" height="100">${kDrawings[name]}</svg>`;
