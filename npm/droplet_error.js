// SPDX-License-Identifier: GPL-3.0-or-later

/** Why there is no droplet. `code` is InvalidArgument, InvalidInput, NoSuchDroplet, OutOfMemory or Internal. */
export class DropletError extends Error {
    constructor(code, message) {
        super(message);
        this.name = 'DropletError';
        this.code = code;
    }
}
