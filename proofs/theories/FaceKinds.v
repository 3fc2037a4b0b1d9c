(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A face of exact points, joined across edges that are not certain: all of it are triangles of one empty circle, or all
   of it are ghost triangles along one line with no site beyond [CLO-2]. *)
From Coq Require Import Reals Lra Psatz Classical List.
From Dyadel Require Import Plane Distance Cells Legal Nerve Orientation Fan TiedFace TiedRim TiedExact ExactFaces.
Open Scope R_scope.

(* Triangles, and ghost triangles by their hull edges. *)
Inductive cell : Type := Real (t : triangle) | Ghost (a b : nat).

Section Face.
Variables (N : nat) (B : sites) (p : nat -> point) (T : list triangle) (H : list (nat * nat)).
Variable drawn : choice N B p.
Variable rim : rimmed N B p T H.
Variable distinct : forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w.
Variable points : forall v, face_vertex T H v -> exact (B v) (p v).

Definition in_face (c : cell) : Prop := match c with Real t => In t T | Ghost a b => In (a, b) H end.

(* One cell after another: the same triangle from its next corner, or across an edge that is not certain, to another
   triangle, to the ghost triangle of a hull edge or from it, or to the next one along the hull. *)
Inductive beside : cell -> cell -> Prop :=
| beside_turned a b c o : In (Tri a b c o) T -> beside (Real (Tri a b c o)) (Real (Tri b c a o))
| beside_edge i j k l o w : In (Tri i j k o) T -> In (Tri j i l w) T -> ~ legal N B i j ->
    beside (Real (Tri i j k o)) (Real (Tri j i l w))
| beside_out i j k o : In (Tri i j k o) T -> In (i, j) H -> ~ legal N B i j -> beside (Real (Tri i j k o)) (Ghost i j)
| beside_in i j k o : In (Tri i j k o) T -> In (i, j) H -> ~ legal N B i j -> beside (Ghost i j) (Real (Tri i j k o))
| beside_on a v b : In (a, v) H -> In (v, b) H -> ~ sure_hull N B v -> beside (Ghost a v) (Ghost v b)
| beside_back a v b : In (a, v) H -> In (v, b) H -> ~ sure_hull N B v -> beside (Ghost v b) (Ghost a v).

(* On the circle of the first triangle; on the line of the first link. *)
Definition on_circle (o : point) (r : R) (c : cell) : Prop :=
  exists i j k, c = Real (Tri i j k o) /\ In (Tri i j k o) T /\ dist o (p i) = r.
Definition on_line (a b : nat) (c : cell) : Prop :=
  exists x y, c = Ghost x y /\ In (x, y) H /\ orient (p a) (p b) (p x) = 0 /\ orient (p a) (p b) (p y) = 0.

Lemma hull_edge_certain i j k o : In (Tri i j k o) T -> In (i, j) H -> legal N B i j.
Proof. exact (face_hull_edge N B p T H drawn rim distinct points i j k o). Qed.

Lemma circle_goes_on o r c d : on_circle o r c -> beside c d -> on_circle o r d.
Proof.
  intros (i & j & k & -> & F & D) S. inversion S as [a b c0 o0 G E | i0 j0 k0 l o0 w G K L E | i0 j0 k0 o0 G K L E | |
    |]; subst.
  - exists j, k, i. destruct (proj1 rim _ _ _ _ F) as [F' [_ [[Ej _] _]]]. split; [reflexivity |]. split; [exact F' |].
    now apply (same_distance o (p i) (p j)).
  - destruct (proj1 rim _ _ _ _ F) as [_ [_ [[Ej _] [Out _]]]].
    destruct (proj1 rim _ _ _ _ K) as [_ [[_ [_ Ll]] [[Wi [Wl O]] _]]].
    assert (Dl : dist o (p l) = dist o (p i)).
    { apply Rle_antisym.
      - apply Rnot_lt_le. intros Q. exact (L (face_edge_legal N B p T H drawn rim distinct points i j k l o w F K Q)).
      - apply dist_le. pose proof (Out l Ll) as Q. unfold about in Q. lra. }
    pose proof (same_distance _ _ _ Ej) as Dj. apply same_distance in Wi, Wl.
    assert (E : o = w) by (apply (circle_determined o w (p j) (p i) (p l)); lra).
    subst w. exists j, i, l. split; [reflexivity |]. split; [exact K | lra].
  - destruct (L (hull_edge_certain i j k o F K)).
Qed.

Lemma line_goes_on a b c d : p a <> p b -> on_line a b c -> beside c d -> on_line a b d.
Proof.
  intros Dab (x & y & -> & F & X & Y) S.
  assert (Apart : forall u v, In (u, v) H -> p u <> p v).
  { intros u v G. destruct (proj2 rim _ _ G) as [[Lu [Lv D]] _]. now apply distinct. }
  assert (Tie : forall u v w, In (u, v) H -> In (v, w) H -> ~ sure_hull N B v -> orient (p u) (p v) (p w) = 0).
  { intros u v w G K L. apply NNPP. intros O. apply L.
    apply (face_corner N B p T H drawn rim distinct points u v w G K); [| exact O].
    intros ->. apply O. unfold orient. ring. }
  inversion S as [| | | i j k o G K L E | u v w G K L E | u v w G K L E]; subst.
  - destruct (L (hull_edge_certain x y k o G K)).
  - exists y, w. split; [reflexivity |]. split; [exact K |]. split; [exact Y |].
    apply (line_carries _ _ (p x) (p y)); auto.
  - exists u, x. split; [reflexivity |]. split; [exact G |]. split; [| exact X].
    apply (line_carries _ _ (p x) (p y)); auto. pose proof (Tie u x y G K L) as Z. unfold orient in *. lra.
Qed.

Lemma circle_reached o r c d : reached beside c d -> on_circle o r c -> on_circle o r d.
Proof. intros R. induction R as [c | c d e S _ IH]; intros Q; [exact Q | apply IH; now apply (circle_goes_on o r c)].
  Qed.

Lemma line_reached a b c d : p a <> p b -> reached beside c d -> on_line a b c -> on_line a b d.
Proof.
  intros D R. induction R as [c | c d e S _ IH]; intros Q; [exact Q | apply IH; now apply (line_goes_on a b c)].
Qed.

Variable connected : forall c d, in_face c -> in_face d -> reached beside c d.

(* With a triangle: no ghost triangle, and all vertices on its circle, which is empty. *)
Theorem circle_face i j k o : In (Tri i j k o) T ->
  H = nil /\ empty_disc N p (face_vertex T H) o (dist o (p i)).
Proof.
  intros F. assert (All : forall c, in_face c -> on_circle o (dist o (p i)) c).
  { intros c C. apply (circle_reached o _ (Real (Tri i j k o)) c); [now apply connected |]. now exists i, j, k. }
  assert (None : forall a b, ~ In (a, b) H).
  { intros a b G. destruct (All (Ghost a b) G) as (x & y & z & E & _). discriminate. }
  split; [destruct H as [| [a b] l]; [reflexivity | destruct (None a b (or_introl eq_refl))] |]. split.
  - intros v _ [[[a b c w] [G <-]] | [b [G | G]]]; [| destruct (None _ _ G) | destruct (None _ _ G)].
    destruct (All (Real (Tri a b c w)) G) as (x & y & z & E & _ & D). injection E as -> -> -> ->. exact D.
  - intros m M. apply dist_le. destruct (proj1 rim _ _ _ _ F) as [_ [_ [_ [Out _]]]]. specialize (Out m M).
    unfold about in Out. lra.
Qed.

(* With a ghost triangle: nothing else, and all vertices on its line, with no site beyond. *)
Theorem line_face a b : In (a, b) H ->
  T = nil /\ exists u m, empty_half_plane N p (face_vertex T H) u m.
Proof.
  intros F. destruct (proj2 rim _ _ F) as [[La [Lb Dab]] [Left _]]. pose proof (distinct a b La Lb Dab) as D.
  assert (All : forall c, in_face c -> on_line a b c).
  { intros c C. apply (line_reached a b (Ghost a b) c D); [now apply connected |]. exists a, b.
    repeat split; try exact F; unfold orient; ring. }
  assert (None : forall t, ~ In t T).
  { intros t G. destruct (All (Real t) G) as (x & y & E & _). discriminate. }
  split; [destruct T as [| t l]; [reflexivity | destruct (None t (or_introl eq_refl))] |].
  set (u := (snd (p b) - snd (p a), fst (p a) - fst (p b))). exists u, (dot u (p a)).
  assert (Q : forall v, dot u (p v) - dot u (p a) = - orient (p a) (p b) (p v)) by (intros; unfold u, dot, orient;
    simpl; ring).
  split; [| split].
  - intros Z. apply D. pose proof (f_equal fst Z) as X. pose proof (f_equal snd Z) as Y. simpl in X, Y.
    rewrite (surjective_pairing (p a)), (surjective_pairing (p b)). f_equal; lra.
  - intros v _ [[t [G _]] | [w [G | G]]]; [destruct (None t G) | |];
      [destruct (All (Ghost v w) G) as (x & y & E & _ & X & Y) | destruct (All (Ghost w v) G) as (x & y & E & _ & X &
        Y)];
      injection E as -> ->; [specialize (Q x) | specialize (Q y)]; lra.
  - intros m M. specialize (Q m). specialize (Left m M). lra.
Qed.

(* So all pairs of its vertices are possible. *)
Theorem face_pairs_possible i j : face_vertex T H i -> face_vertex T H j -> possible N B i j.
Proof.
  intros Vi Vj. pose proof (vertex_below N B p T H rim) as Below.
  destruct T as [| [a b c o] l] eqn:ET; [destruct H as [| [a b] l] eqn:EH |].
  - destruct Vi as [[t [[] _]] | [x [[] | []]]].
  - rewrite <- EH, <- ET in *. destruct (line_face a b) as [_ (u & m & E)]; [rewrite EH; now left |].
    apply (line_pairs_possible N B p (face_vertex T H) u m); auto.
  - rewrite <- ET in *. destruct (circle_face a b c o) as [_ E]; [rewrite ET; now left |].
    apply (circle_pairs_possible N B p (face_vertex T H) o (dist o (p a))); auto.
Qed.
End Face.
