// SPDX-License-Identifier: MIT
/** What a bundler makes of a file that is taken along: its address. */
declare const address: string;
export default address;
