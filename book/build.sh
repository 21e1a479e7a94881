#!/usr/bin/env bash
# Builds the book in target/book from the chapters in book/src. Adds a page for each operation, made from ops/README.md.
set -euo pipefail
cd "$(dirname "$0")/.."
out=target/book-source
rm -rf "$out" && mkdir -p "$out/src/operations"
cp book/book.toml book/run_here.js "$out" && cp -r book/src/. "$out/src"

# Splits the generated reference into one page for each operation, and one for the types of parameters.
awk -v out="$out/src/operations" '
    /^# Steps that contain steps/ { page = out "/types.md"; print "# Types of parameters\n" > page }
    /^## / && page != out "/types.md" { page = out "/" $2 ".md"; sub("^## ", "# ") }
    page { gsub(/\(all\/pictures\//, "(../pictures/"); if (!/^# Types of parameters/ || page !~ /types/) print > page }
' ops/README.md
mkdir "$out/src/pictures" && cp -r ops/all/pictures/. "$out/src/pictures"
{
    printf '# Operations\n\n'
    sed -n 's|^- \[\([A-Za-z0-9]*\)\](#[^)]*): \(.*\)|- [\1](operations/\1.md): \2|p' ops/README.md
    printf -- '- [Types of parameters](operations/types.md)\n'
} > "$out/src/operations.md"
pages=$(sed -n 's|^- \[\([A-Za-z0-9]*\)\](#.*|  - [\1](operations/\1.md)|p' ops/README.md)
awk -v pages="$pages\n  - [Types of parameters](operations/types.md)" '
    { print } /\(operations.md\)/ { print pages }
    /\(files.md\)/ { print "  - [What formats preserve](kept.md)" }
    /\(python.md\)/ { print "  - [A notebook](curvature.md)" }
' book/src/SUMMARY.md > "$out/src/SUMMARY.md"
# The cells of the notebook, without their results.
python3 - crates/python/examples/curvature.ipynb > "$out/src/curvature.md" << 'END'
import json, sys

for cell in json.load(open(sys.argv[1], encoding="utf-8"))["cells"]:
    text = "".join(cell["source"])
    print(text if cell["cell_type"] == "markdown" else f"```python,ignore\n{text}\n```", end="\n\n")
END
# In the repository, these links refer to other files; in the book, to other pages.
cp crates/io/src/kept.md "$out/src/kept.md"
sed -i -e 's|(../../crates/io/src/kept.md)|(kept.md)|' -e 's|(../../crates/python/examples/curvature.ipynb)|(curvature.md)|' -e 's|(../../ops/README.md#reasons-for-refused)|(operations/types.md#reasons-for-refused)|' "$out"/src/*.md
# Copies pictures from other folders of the repository.
for image in $(grep -oh '](\.\./\.\./[^)]*png' "$out"/src/*.md | sed 's|](../../||'); do
    mkdir -p "$out/src/images/$(dirname "$image")"
    cp "$image" "$out/src/images/$image"
done
sed -i 's|](\.\./\.\./\([^)]*png\)|](images/\1|g' "$out"/src/*.md
mdbook build "$out" --dest-dir "$PWD/target/book"
# The page that "Run it here" opens.
if [ -d target/web/page ]; then
    rm -rf target/book/page
    cp -r target/web/page target/book/page
    cp crates/web/page/share.js target/book/page
else
    echo "The page for browsers is not built (crates/web/build.sh), so the book has no links to run its recipes."
fi
