#!/bin/sh
# Runs a command that makes figures and tables, shows what it prints, and leaves index.html beside the figures:
#   sh tests/measure/figures.sh FOLDER TITLE COMMAND...        FOLDER: where the command puts its figures
# In the command's output "== TEXT" begins a section. "figure FILE TEXT" names a figure and its caption (on the page
# only); its first sentence is what is read out in place of the picture, and "figure FILE LABEL | TEXT" names it itself.
# "table TEXT" begins a table with this caption: its next line is the heading, and it ends at an empty line; cells are
# separated by two blanks or more. All other lines are remarks, of which one that begins with a blank, or follows on an
# empty line, is a paragraph of its own. The exit status is that of the command, or 1 if a figure is
# missing.
folder=$1 title=$2; shift 2
mkdir -p "$folder" || exit 2
{ "$@" 2>&1; echo $? >"$folder/status"; } | tee "$folder/record" | sed '/^figure /d; s/^table //'
awk -v title="$title" -f "${0%.sh}.awk" "$folder/record" >"$folder/index.html" || exit 2
status=$(cat "$folder/status")
for figure in $(sed -n 's/^figure \([^ ]*\).*/\1/p' "$folder/record"); do
    [ -s "$folder/$figure" ] || { echo "FAILED: no figure $folder/$figure"; status=1; }
done
rm -f "$folder/record" "$folder/status"
echo "Figures and tables on one page: $folder/index.html"
exit "$status"
