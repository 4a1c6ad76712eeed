#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# tools/site.sh [FOLDER]   makes one site of README.md and docs/, with a search box and a list of all pages, in out/site/README.html
#                          (or in FOLDER). It opens from the file, without a server. A warning of Sphinx fails it.
set -eu
cd "$(dirname "$0")/.."
tools/install.sh site
folder=${1:-out/site}
/usr/bin/python3 -m sphinx -q -W --keep-going -b html -d "$folder/.doctrees" -c tools/site . "$folder"
rm -rf "$folder/.doctrees"
echo "$folder/README.html"
