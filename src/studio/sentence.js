// SPDX-License-Identifier: MIT

/** An error's message as a sentence on one line. */
export const sentence = ({ message }) => message.charAt(0).toUpperCase() + message.slice(1).replaceAll('\n', ' ');
