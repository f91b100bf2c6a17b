# behind_page SCRIPT...: for scripts behind a page of `harmorph explore` in headless Chromium.
# Writes scripts that begin when the page has started. The page counts as loaded when the script has left its findings:
# an empty frame, whose document stays open until then, holds this back.
behind_page() {
    cat <<'END'
<script>
const held = document.body.appendChild(document.createElement("iframe"));
held.hidden = true;
held.contentDocument.open();
const waiting = setInterval(() => {
    if (![...document.querySelectorAll("pre")].some((node) => /result ends/.test(node.textContent))) return;
    clearInterval(waiting);
    held.contentDocument.close();
}, 10);
page_started.then(() => {
END
    cat "$@"
    cat <<'END'
}).catch((error) => {
    const result = document.createElement("pre");
    result.textContent = `\nresult begins\ncheck script FAILED ${error.stack}\nresult ends\n`;
    document.body.append(result);
});
</script>
END
}
