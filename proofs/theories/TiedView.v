(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* From a point one looks at a way of sides and back behind the point: straight down from the end of the way, to two given
   directions, and to its beginning. How often this winds around the point stays as it is while all move, if the point
   is never on a side; it is -1 or less beyond a way on a line, and 0 next to the end of a convex one. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List.
From Dyadel Require Import Plane Orientation Path TiedRim Winding TiedTree.
Open Scope R_scope.

Definition shift (v z : point) : point := (fst z + fst v, snd z + snd v).
Definition turn (x y : point) : R := fst x * snd y - snd x * fst y.
Definition down : point := (0, -1).

Lemma total_walk g a E z : walk a E z -> total (fun x y => (g y - g x)%Z) E = (g z - g a)%Z.
Proof.
  revert a. induction E as [| [x y] E IH]; intros a W; [simpl in W; subst; unfold total; simpl; lia |].
  destruct W as [-> W]. specialize (IH y W). unfold total in *. simpl. lia.
Qed.

(* ---- the way back, as seen from z ---- *)

(* From b down, to n, to u, to a. *)
Definition way_back (n u z a b : point) : Z :=
  (passes z b (shift down z) + passes z (shift down z) (shift n z) + passes z (shift n z) (shift u z) +
   passes z (shift u z) a)%Z.

Lemma off_down a z : snd a < snd z -> ~ between z a (shift down z).
Proof.
  intros L [r [S Z]]. apply (f_equal snd) in Z. unfold mix, shift, down in Z. simpl in Z.
  assert (0 <= (1 - r) * (snd z - snd a)) by (apply Rmult_le_pos; lra).
  destruct (Req_dec r 0) as [-> | D]; lra.
Qed.

Lemma off_first n z : 0 < fst n -> ~ between z (shift down z) (shift n z).
Proof.
  intros L [r [S Z]]. pose proof (f_equal fst Z) as X. pose proof (f_equal snd Z) as Y. unfold mix, shift, down in X, Y.
  simpl in X, Y. assert (E : r * fst n = 0) by lra. destruct (Rmult_integral _ _ E) as [-> | ?]; lra.
Qed.

Lemma off_second n u z : 0 < fst n -> 0 < turn n u -> ~ between z (shift n z) (shift u z).
Proof.
  intros L D [r [S Z]]. pose proof (f_equal fst Z) as X. pose proof (f_equal snd Z) as Y. unfold mix, shift in X, Y.
  simpl in X, Y. assert (X' : (1 - r) * fst n + r * fst u = 0) by lra.
  assert (Y' : (1 - r) * snd n + r * snd u = 0) by lra.
  assert (E : r * turn n u = 0).
  { transitivity (fst n * ((1 - r) * snd n + r * snd u) - snd n * ((1 - r) * fst n + r * fst u));
      [unfold turn; ring | rewrite X', Y'; ring]. }
  destruct (Rmult_integral _ _ E) as [-> | ?]; lra.
Qed.

Lemma off_last n u z a : 0 < turn n u -> dot u z < dot u a -> ~ between z (shift u z) a.
Proof.
  intros D L [r [S Z]]. assert (E : dot u z = (1 - r) * (dot u z + dot u u) + r * dot u a).
  { rewrite Z at 1. unfold dot, mix, shift. simpl. ring. }
  assert (P : 0 < dot u u).
  { unfold dot. destruct (Req_dec (fst u) 0) as [F | F]; [| nra]. destruct (Req_dec (snd u) 0) as [G | G]; [| nra].
    unfold turn in D. rewrite F, G in D. lra. }
  assert (0 <= (1 - r) * dot u u) by (apply Rmult_le_pos; lra).
  destruct (Req_dec r 0) as [-> | R0]; [lra |].
  assert (0 < r * (dot u a - dot u z)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma shift_continuous f c : continuity f -> continuity (fun s => f s + c).
Proof. intros F. apply (continuity_plus f (fun _ => c)); [exact F | apply continuity_const; now intros ? ?]. Qed.

Theorem view_steady N L f l n u (pos : nat -> R -> point) (z : R -> point) : walk f L l -> (f < N)%nat -> (l < N)%nat ->
  (forall a b, In (a, b) L -> (a < N)%nat /\ (b < N)%nat) ->
  (forall v, continuity (fun s => fst (pos v s)) /\ continuity (fun s => snd (pos v s))) ->
  continuity (fun s => fst (z s)) /\ continuity (fun s => snd (z s)) -> 0 < fst n -> 0 < turn n u ->
  (forall t, 0 <= t <= 1 -> snd (pos l t) < snd (z t) /\ dot u (z t) < dot u (pos f t)) ->
  (forall t a b, 0 <= t <= 1 -> In (a, b) L -> ~ between (z t) (pos a t) (pos b t)) ->
  let winds t := (total (fun a b => passes (z t) (pos a t) (pos b t)) L + way_back n u (z t) (pos f t) (pos l t))%Z in
  winds 1 = winds 0.
Proof.
  intros W Fn Ln Below Mp Mz P1 P2 Ends Off winds.
  set (all := fun v s => if Nat.ltb v N then pos v s else
    match (v - N)%nat with O => shift down (z s) | S O => shift n (z s) | _ => shift u (z s) end).
  set (tail := (l, N) :: (N, S N) :: (S N, S (S N)) :: (S (S N), f) :: nil).
  assert (Low : forall v s, (v < N)%nat -> all v s = pos v s)
    by (intros v s V; unfold all; apply Nat.ltb_lt in V; now rewrite V).
  assert (A0 : forall s, all N s = shift down (z s))
    by (intros s; unfold all; now rewrite Nat.ltb_irrefl, Nat.sub_diag).
  assert (A1 : forall s, all (S N) s = shift n (z s)).
  { intros s. unfold all. replace (Nat.ltb (S N) N) with false by (symmetry; apply Nat.ltb_ge; lia).
    now replace (S N - N)%nat with 1%nat by lia. }
  assert (A2 : forall s, all (S (S N)) s = shift u (z s)).
  { intros s. unfold all. replace (Nat.ltb (S (S N)) N) with false by (symmetry; apply Nat.ltb_ge; lia).
    now replace (S (S N) - N)%nat with 2%nat by lia. }
  assert (Sum : forall s, total (fun a b => passes (z s) (all a s) (all b s)) (L ++ tail) = winds s).
  { intros s. unfold winds. rewrite total_app. f_equal.
    - apply total_same. intros a b F. destruct (Below a b F). now rewrite !Low.
    - unfold total, tail, way_back. simpl. rewrite A0, A1, A2, !Low by assumption. lia. }
  rewrite <- !Sum. apply winding_steady; [| | exact Mz |].
  - intros g. rewrite total_app, (total_walk g f L l W). unfold total, tail. simpl. lia.
  - intros v. unfold all. destruct (Nat.ltb v N); [apply Mp |].
    destruct (v - N)%nat as [| [| k]]; unfold shift; simpl; split; apply shift_continuous; apply Mz.
  - intros t a b S F. destruct (Ends t S) as [Lo Hi]. apply in_app_or in F as [F | F].
    + destruct (Below a b F). rewrite !Low by assumption. now apply Off.
    + unfold tail in F. simpl in F. destruct F as [F | [F | [F | [F | []]]]]; injection F as <- <-.
      * rewrite A0, Low by assumption. now apply off_down.
      * rewrite A0, A1. now apply off_first.
      * rewrite A1, A2. now apply off_second.
      * rewrite A2, Low by assumption. now apply (off_last n).
Qed.

(* ---- how often it winds ---- *)

Lemma way_back_value n u z a b : 0 < fst n -> 0 < turn n u -> snd b < snd z ->
  way_back n u z a b = (right z (shift u z) - 1 + passes z (shift u z) a)%Z.
Proof.
  intros P1 P2 L. unfold way_back. rewrite (ends_below z b); [| exact L | unfold shift, down; simpl; lra].
  unfold passes at 1 2.
  destruct (right_cases z (shift down z)) as [[-> A] | [-> A]]; [| unfold shift, down in A; simpl in A; lra].
  destruct (right_cases z (shift n z)) as [[-> C] | [-> C]]; [| unfold shift in C; simpl in C; lra].
  destruct (right_cases z (shift u z)) as [[-> _] | [-> _]]; [lia |].
  destruct (Rlt_dec 0 (orient (shift n z) (shift u z) z)) as [_ | D]; [lia |]. exfalso. apply D.
  unfold orient, shift, turn in *. simpl. lra.
Qed.

(* To a point above z, and beyond it in the direction of u. *)
Lemma up_from u z a : dot u z < dot u a -> snd z < snd a ->
  passes z (shift u z) a = (right z a - right z (shift u z))%Z.
Proof.
  intros D Up. assert (O : orient (shift u z) a z = fst u * (snd a - snd z) - snd u * (fst a - fst z))
    by (unfold orient, shift; simpl; ring).
  assert (Q : 0 < fst u * (fst a - fst z) + snd u * (snd a - snd z)) by (unfold dot in D; lra).
  apply passes_above; intros [X Y]; rewrite O; unfold shift in X, Y; simpl in X, Y.
  - assert (0 <= - fst u * (fst a - fst z)) by (apply Rmult_le_pos; lra).
    assert (U : 0 < snd u) by (apply (Rmult_lt_reg_r (snd a - snd z)); lra).
    assert (0 < - fst u * (snd a - snd z)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= snd u * (fst a - fst z)) by (apply Rmult_le_pos; lra). lra.
  - assert (0 <= fst u * - (fst a - fst z)) by (apply Rmult_le_pos; lra).
    assert (U : 0 < snd u) by (apply (Rmult_lt_reg_r (snd a - snd z)); lra).
    assert (0 <= fst u * (snd a - snd z)) by (apply Rmult_le_pos; lra).
    assert (0 < snd u * - (fst a - fst z)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* At a point beyond the line from a to b. *)
Lemma winds_beyond n u z a b : 0 < fst n -> 0 < turn n u -> snd b < snd z -> snd b < snd a ->
  dot u z < dot u a -> dot u b < dot u a -> 0 < orient a b z -> (passes z a b + way_back n u z a b < 0)%Z.
Proof.
  intros P1 P2 Lz La Uz Ub O. rewrite way_back_value by assumption.
  set (x0 := fst a - fst z). set (y0 := snd a - snd z). set (x1 := fst b - fst z). set (y1 := snd b - snd z).
  assert (C : orient a b z = x0 * y1 - y0 * x1) by (unfold orient, x0, y0, x1, y1; ring).
  set (al := fst u * x0 + snd u * y0). set (be := fst u * x1 + snd u * y1).
  assert (Al : 0 < al) by (unfold al, x0, y0; unfold dot in Uz; lra).
  assert (Be : be < al) by (unfold al, be, x0, y0, x1, y1; unfold dot in Ub; lra).
  assert (Y1 : y1 < 0) by (unfold y1; lra). assert (Y10 : y1 < y0) by (unfold y0, y1; lra).
  assert (Id : orient a b z * fst u = al * y1 - be * y0) by (rewrite C; unfold al, be; ring).
  assert (Key : 0 <= fst u -> 0 < y0).
  { intros U. apply Rnot_le_lt. intros Y. assert (0 <= orient a b z * fst u) by (apply Rmult_le_pos; lra).
    assert (0 <= (al - be) * - y0) by (apply Rmult_le_pos; lra).
    assert (0 < al * (y0 - y1)) by (apply Rmult_lt_0_compat; lra). lra. }
  assert (Side : 0 <= x0 -> 0 <= x1 -> y0 < 0).
  { intros X0 X1. apply Rnot_le_lt. intros Y. assert (0 <= x0 * - y1) by (apply Rmult_le_pos; lra).
    assert (0 <= y0 * x1) by (apply Rmult_le_pos; lra). lra. }
  destruct (right_cases z (shift u z)) as [[Ru U] | [Ru U]]; unfold shift in U; simpl in U.
  - rewrite up_from; [| exact Uz | specialize (Key ltac:(lra)); unfold y0 in Key; lra]. rewrite Ru.
    unfold passes. destruct (right_cases z a) as [[-> X] | [-> X]]; destruct (right_cases z b) as [[-> Y] | [-> Y]];
      try lia.
    + exfalso. specialize (Key ltac:(lra)). specialize (Side ltac:(unfold x0; lra) ltac:(unfold x1; lra)). lra.
    + destruct (Rlt_dec 0 (orient a b z)); [lia | lra].
    + destruct (Rlt_dec (orient a b z) 0); [lra | lia].
  - assert (V : orient (shift u z) a z = fst u * y0 - snd u * x0)
      by (unfold orient, shift, x0, y0; simpl; ring).
    unfold passes. rewrite Ru.
    destruct (right_cases z a) as [[-> X] | [-> X]]; destruct (right_cases z b) as [[-> Y] | [-> Y]].
    + destruct (Rlt_dec (orient (shift u z) a z) 0) as [K | K]; [exfalso | lia].
      specialize (Side ltac:(unfold x0; lra) ltac:(unfold x1; lra)).
      assert (0 <= - fst u * x0) by (apply Rmult_le_pos; unfold x0; lra).
      assert (0 < - snd u) by (apply (Rmult_lt_reg_r (- y0)); unfold al in Al; lra).
      assert (0 <= - snd u * x0) by (apply Rmult_le_pos; unfold x0; lra).
      assert (0 < - fst u * - y0) by (apply Rmult_lt_0_compat; lra). lra.
    + destruct (Rlt_dec 0 (orient a b z)); [| lra]. destruct (Rlt_dec (orient (shift u z) a z) 0); lia.
    + destruct (Rlt_dec (orient a b z) 0); [lra | lia].
    + lia.
Qed.

(* Around a point next to the end b of the hull's edge from b to h, where all else is above. *)
Lemma winds_not_next_to n u z a b h : 0 < fst n -> 0 < turn n u -> snd b < snd z -> snd z < snd h ->
  snd z < snd a -> dot u z < dot u a -> 0 < orient b h z ->
  (way_back n u z a b = passes z b h + (right z a - right z h))%Z.
Proof.
  intros P1 P2 Lb Lh La U O. rewrite way_back_value, up_from by assumption.
  assert (K : passes z b h = (right z h - 1)%Z); [| lia]. unfold passes.
  destruct (right_cases z b) as [[-> X] | [-> X]]; destruct (right_cases z h) as [[-> Y] | [-> Y]]; try lia.
  - destruct (Rlt_dec 0 (orient b h z)); [lia | lra].
  - destruct (Rlt_dec (orient b h z) 0); [lra | lia].
  - exfalso. rewrite orient_heights in O.
    assert (0 < (fst z - fst h) * (snd z - snd b)) by (apply Rmult_lt_0_compat; lra).
    assert (0 < (fst z - fst b) * (snd h - snd z)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* Sides on one line, and z off it. *)
Lemma winds_not_beside_line E f l (q : nat -> point) z : walk f E l -> orient (q f) (q l) z <> 0 ->
  (forall a b, In (a, b) E -> orient (q f) (q l) (q a) = 0 /\ orient (q f) (q l) (q b) = 0) ->
  total (fun a b => passes z (q a) (q b)) E = passes z (q f) (q l).
Proof.
  intros W O On. set (dx := fst (q l) - fst (q f)). set (dy := snd (q l) - snd (q f)).
  assert (Par : forall a b, In (a, b) E \/ (a, b) = (f, l) ->
    dx * (snd (q b) - snd (q a)) = dy * (fst (q b) - fst (q a)) /\
    dx * orient (q a) (q b) z = (fst (q b) - fst (q a)) * orient (q f) (q l) z).
  { assert (F : orient (q f) (q l) (q f) = 0 /\ orient (q f) (q l) (q l) = 0) by (unfold orient; split; ring).
    intros a b H. assert (G : orient (q f) (q l) (q a) = 0 /\ orient (q f) (q l) (q b) = 0)
      by (destruct H as [H | H]; [now apply On | now injection H as -> ->]). destruct G as [Ga Gb].
    assert (P : dx * (snd (q b) - snd (q a)) = dy * (fst (q b) - fst (q a))).
    { apply Rminus_diag_uniq. transitivity (orient (q f) (q l) (q b) - orient (q f) (q l) (q a));
        [unfold orient, dx, dy; ring | lra]. }
    split; [exact P |]. apply Rminus_diag_uniq.
    transitivity (- (dx * (snd (q b) - snd (q a)) - dy * (fst (q b) - fst (q a))) * (fst z - fst (q a)) +
      (fst (q b) - fst (q a)) * orient (q f) (q l) (q a) * -1); [unfold orient, dx, dy; ring | rewrite P, Ga; ring]. }
  destruct (Req_dec dx 0) as [Z | Z].
  - (* a vertical line *)
    assert (Dy : dy <> 0) by (intros Y; apply O; unfold orient; fold dx dy; rewrite Z, Y; ring).
    assert (Same : forall a b, In (a, b) E \/ (a, b) = (f, l) -> passes z (q a) (q b) = 0%Z).
    { intros a b H. destruct (Par a b H) as [P _]. rewrite Z, Rmult_0_l in P. symmetry in P.
      destruct (Rmult_integral _ _ P) as [P' | P']; [contradiction |].
      unfold passes, right. replace (fst (q b)) with (fst (q a)) by lra.
      now destruct (Rle_dec (fst z) (fst (q a))). }
    rewrite (Same f l) by (now right). rewrite (total_same _ (fun _ _ => (0 - 0)%Z)) by (intros; apply Same; now left).
    exact (total_walk (fun _ => 0%Z) f E l W).
  - destruct (Rlt_dec 0 (dx * orient (q f) (q l) z)) as [Up | Dn].
    + assert (Same : forall a b, In (a, b) E \/ (a, b) = (f, l) -> passes z (q a) (q b) = 0%Z).
      { intros a b H. destruct (Par a b H) as [_ P].
        assert (P' : dx * dx * orient (q a) (q b) z = (fst (q b) - fst (q a)) * (dx * orient (q f) (q l) z))
          by (rewrite Rmult_assoc, P; ring). assert (0 < dx * dx) by nra.
        apply passes_below; intros [X Y].
        - apply (Rmult_le_reg_l (dx * dx)); [assumption |]. rewrite P', Rmult_0_r. apply Rmult_le_pos; lra.
        - apply (Rmult_le_reg_l (dx * dx)); [assumption |]. rewrite P', Rmult_0_r.
          assert (0 <= (fst (q a) - fst (q b)) * (dx * orient (q f) (q l) z)) by (apply Rmult_le_pos; lra). lra. }
      rewrite (Same f l) by (now right). rewrite (total_same _ (fun _ _ => (0 - 0)%Z)) by (intros; apply Same; now left).
      exact (total_walk (fun _ => 0%Z) f E l W).
    + assert (Dn' : dx * orient (q f) (q l) z < 0).
      { destruct (Req_dec (dx * orient (q f) (q l) z) 0) as [X | X]; [| lra].
        destruct (Rmult_integral _ _ X); contradiction. }
      assert (Same : forall a b, In (a, b) E \/ (a, b) = (f, l) ->
        passes z (q a) (q b) = (right z (q b) - right z (q a))%Z).
      { intros a b H. destruct (Par a b H) as [_ P].
        assert (P' : dx * dx * orient (q a) (q b) z = (fst (q b) - fst (q a)) * (dx * orient (q f) (q l) z))
          by (rewrite Rmult_assoc, P; ring). assert (0 < dx * dx) by nra.
        apply passes_above; intros [X Y].
        - apply (Rmult_lt_reg_l (dx * dx)); [assumption |]. rewrite P', Rmult_0_r.
          assert (0 < (fst (q b) - fst (q a)) * - (dx * orient (q f) (q l) z)) by (apply Rmult_lt_0_compat; lra). lra.
        - apply (Rmult_lt_reg_l (dx * dx)); [assumption |]. rewrite P', Rmult_0_r.
          assert (0 < (fst (q a) - fst (q b)) * - (dx * orient (q f) (q l) z)) by (apply Rmult_lt_0_compat; lra). lra. }
      rewrite (Same f l) by (now right).
      rewrite (total_same _ (fun a b => (right z (q b) - right z (q a))%Z)) by (intros; apply Same; now left).
      exact (total_walk (fun v => right z (q v)) f E l W).
Qed.
