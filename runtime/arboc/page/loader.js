// Gives the page's modules the names by which they import each other, and runs the main one.
{
  const page = JSON.parse(document.getElementById("arboc-page").textContent);
  const imports = {};
  for (const [name, text] of Object.entries(page.modules))
    imports[name] = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  const map = document.createElement("script");
  map.type = "importmap";
  map.textContent = JSON.stringify({ imports });
  document.head.append(map);
  window.arboc = { data: page.data };
  import(imports[page.main]).catch((error) => {
    const note = document.createElement("p");
    note.className = "failure";
    note.textContent = `This page does not run here: ${error.message}`;
    document.body.prepend(note);
    throw error;
  });
}
