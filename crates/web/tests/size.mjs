// Compresses FILE with brotli to FILE.br, and prints both sizes. Fails if the compressed size exceeds the limit. Usage:
// size.mjs FILE
import { readFileSync, writeFileSync } from "node:fs";
import { brotliCompressSync, constants } from "node:zlib";

/// The maximum compressed size in bytes.
const LIMIT = 2_500_000;

const bytes = readFileSync(process.argv[2]);
const options = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length,
    [constants.BROTLI_PARAM_LGWIN]: 24 };
const compressed = brotliCompressSync(bytes, { params: options });
writeFileSync(`${process.argv[2]}.br`, compressed);
console.log(`WebAssembly: ${bytes.length} bytes, ${compressed.length} bytes as brotli, limit ${LIMIT}`);
process.exitCode = compressed.length > LIMIT ? 1 : 0;
