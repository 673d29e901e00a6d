// A button that copies a listing.

async function copied(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

/** Where the browser lets nobody write to the clipboard, the text is selected instead. */
function select(code: HTMLElement): void {
  getSelection()?.selectAllChildren(code);
}

export function addCopyButtons(): void {
  for (const listing of document.querySelectorAll<HTMLElement>("pre")) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "copy";
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
      const done = await copied(listing.textContent ?? "");
      if (!done) select(listing);
      button.textContent = done ? "Copied" : "Selected";
      setTimeout(() => (button.textContent = "Copy"), 2000);
    });
    const box = document.createElement("div");
    box.className = "listing";
    listing.replaceWith(box);
    box.append(listing, button);
  }
}
