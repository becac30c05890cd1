#!/usr/bin/env bash
# Builds the documentation site into build/docs/html: Doxygen reads the public headers, Sphinx the pages
# in this folder. Every warning of either is an error. `apps/setup.sh --docs` installs both.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
out=../build/docs
mkdir -p "$out"
out=$(cd "$out" && pwd)

rm -rf "$out/xml"
(cat Doxyfile; echo "OUTPUT_DIRECTORY = \"$out\"") | doxygen -
# Each header would declare the namespace once more; private members are nobody's business.
sed -i '/<innernamespace /d' "$out"/xml/*_8hpp.xml
sed -i '/<sectiondef kind="private/,/<\/sectiondef>/d; /<innerclass .*prot="private"/d' \
  "$out"/xml/class*.xml "$out"/xml/struct*.xml
# Sphinx' word to the authors of extensions is not for us.
PYTHONWARNINGS=ignore VANTAGE_DOXYGEN_XML=$out/xml \
  sphinx-build -W --keep-going -q -b html -d "$out/doctrees" . "$out/html"
echo "$out/html/index.html"
