// SPDX-License-Identifier: Apache-2.0
// node wasi.mjs PROGRAM: runs a wasm32-wasi program as the engine of a browser does, and prints its output.
import {readFile} from 'node:fs/promises';
import process from 'node:process';
import {WASI} from 'node:wasi';

const wasi = new WASI({version: 'preview1', args: process.argv.slice(2), preopens: {'.': '.'}, returnOnExit: true});
const module = await WebAssembly.compile(await readFile(process.argv[2]));
const instance = await WebAssembly.instantiate(module, {wasi_snapshot_preview1: wasi.wasiImport});
process.exitCode = wasi.start(instance);
