#!/usr/bin/env bash
# Makes a static site of the documents, which needs neither a server nor a network: docs/site/build.sh OUT
# Needs pandoc, which sets the equations as MathML.
set -euo pipefail

root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..
out=${1:?give the folder of the site}
here=$root/docs/site
cd "$root"
mkdir -p "$out"
out=$(readlink -f "$out")

title_of() { sed -n 's/^# //p' "$1" | head -n 1; }

# A page's place in the site, from a document's in the repository.
page_of() {
  local page=${1%.md}.html
  printf '%s' "${page/README.html/index.html}"
}

# One list of links; $1 leads from the page to the site's root.
nav() {
  local up=$1 file
  section() {
    printf '<h2>%s</h2><ul>' "$1"
    shift
    for file in "$@"; do printf '<li><a href="%s%s">%s</a></li>' "$up" "$(page_of "$file")" "$(title_of "$file")"; done
    printf '</ul>'
  }
  section 'Start' docs/tutorial.md
  section 'How to' docs/how-to/{bring-your-data,choose-an-estimator,read-a-diagnosis,design-the-next-experiment,use-the-model,reproduce-the-paper,run-a-study-on-a-cluster,add-an-effect}.md
  section 'Background' docs/theory.md docs/limits.md docs/diagnosis.md docs/fits.md docs/simulation.md docs/trials.md
  section 'Reference' docs/reference/README.md docs/effects/README.md docs/dataset.md docs/import.md docs/sanity.md docs/model-file.md docs/export.md docs/study-file.md docs/study-kinds.md docs/artefacts.md docs/library.md
  local known=" tutorial theory limits diagnosis fits simulation trials dataset import sanity model-file export study-file study-kinds artefacts library " others=()
  for file in docs/*.md; do
    [[ $known == *" $(basename "$file" .md) "* ]] || others+=("$file")
  done
  section 'More' "${others[@]}" CONTRIBUTING.md
}

convert() {
  local file=$1 up page
  page=$(page_of "$file")
  up=$(dirname "$file" | sed -e 's|^\.$||' -e 's|[^/][^/]*|..|g' -e 's|$|/|' -e 's|^/$||')
  mkdir -p "$out/$(dirname "$page")"
  pandoc --from=gfm+tex_math_dollars --to=html5 --mathml --standalone \
    --toc --toc-depth=2 --template="$here/template.html" --lua-filter="$here/links.lua" \
    --variable="root=$up" --variable="nav=$(nav "$up")" --metadata="pagetitle=$(title_of "$file")" \
    --output="$out/$page" "$file"
}

cp "$here/style.css" "$out/"
mkdir -p "$out/docs"
cp -r docs/images docs/examples "$out/docs/"
mkdir -p "$out/docs/effects"
cp -r docs/effects/figures "$out/docs/effects/"
while read -r file; do convert "$file" & while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n; done; done < <(
  printf '%s\n' README.md CONTRIBUTING.md CHANGELOG.md; find docs -name '*.md' | sort)
wait
